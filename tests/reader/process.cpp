#include "reader/process.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace dotyk;

TEST_CASE("a reader that was not built is missed by the name of its library") {
  CHECK_THROWS_WITH_AS(reader::require_program("dotyk_none", "a library (install it)"), "this dotyk was built without a library (install it)", std::runtime_error);
  CHECK_THROWS_WITH_AS(reader::require_program("dotyk", "a library"), "this dotyk was built without a library", std::runtime_error);  // a part of a name
  CHECK(reader::require_program("dotyk_vtu", "VTK's library").ends_with("/dotyk_vtu"));  // always built; see too script/surroundings
}

#include <doctest/doctest.h>

#include "script/help/nearest.hpp"

using namespace dotyk::script;

TEST_CASE("edit distance counts slips") {
  CHECK(edit_distance("friction", "friction") == 0);
  CHECK(edit_distance("fricton", "friction") == 1);
  CHECK(edit_distance("firction", "friction") == 1);  // neighbours swapped
  CHECK(edit_distance("FRICTION", "friction") == 0);
  CHECK(edit_distance("", "abc") == 3);
}

TEST_CASE("nearest takes slips and beginnings, and nothing far") {
  const std::vector<std::string> names = {"friction", "pairing", "gap", "rigid", "max_iterations"};
  CHECK(nearest("fricton", names) == "friction");
  CHECK(nearest("pair", names) == "pairing");
  CHECK(nearest("max_iter", names) == "max_iterations");
  CHECK(nearest("gaps", names) == "gap");
  CHECK(nearest("colour", names).empty());
  CHECK(nearest("", names).empty());
  CHECK(nearest("x", {"y", "z"}).empty());
  CHECK(nearest("e", {"E", "nu"}) == "E");
}

TEST_CASE("texts of unknown names") {
  CHECK(unknown_name("key", "fricton", {"friction", "gap"}) ==
        "unknown key 'fricton', did you mean 'friction'?");
  CHECK(unknown_name("key", "zzz", {"friction", "gap"}) == "unknown key 'zzz', expected 'friction' or 'gap'");
  CHECK(unknown_name("key", "zzz", {}) == "unknown key 'zzz'");
}

#include "reader/process.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "base/error.hpp"

using namespace dotyk;

TEST_CASE("a reader that was not built is missed by the name of its library") {
  CHECK_THROWS_WITH_AS(reader::require_program("dotyk_none", "a library (install it)"), "this dotyk was built without a library (install it)", std::runtime_error);
  CHECK_THROWS_WITH_AS(reader::require_program("dotyk", "a library"), "this dotyk was built without a library", std::runtime_error);  // a part of a name
  CHECK(reader::require_program("dotyk_vtu", "VTK's library").ends_with("/dotyk_vtu"));  // always built; see too script/surroundings
}

TEST_CASE("a reader that is ended or needs too much: what it was, and what that may come from") {
  Monitor monitor;
  const auto message = [&](const char* commands, const char* why) {
    try {
      reader::output_of("/bin/sh", {"-c", commands}, "disc", monitor, why);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("none");
  };
  CHECK(message("kill -XCPU $$", "is it endless?") == "disc: it takes more processors' time than it may; is it endless?");
  CHECK(message("kill -KILL $$", "is it endless?") == "disc: the system has ended its reader, as it does where memory is short; is it endless?");
  CHECK(message("exit 3", "is it endless?") == "disc: it needs more memory than there is; is it endless?");
  CHECK(message("echo it is empty; exit 1", "is it endless?") == "disc: it is empty\n");
  CHECK(message("kill -SEGV $$", "the file may be damaged").starts_with("disc: the library that reads it crashed on it ("));
}

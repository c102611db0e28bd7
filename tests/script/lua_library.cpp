// liblua5.4 and liblua5.4-c++ export the same symbols; with the wrong one,
// errors would skip destructors.
#include <doctest/doctest.h>

#include <fstream>
#include <set>
#include <string>

#include "bench.hpp"

using dotyk::script::Bench;

TEST_CASE("one Lua library is loaded, the one compiled as C++") {
  std::ifstream maps("/proc/self/maps");
  std::set<std::string> libraries;
  for (std::string line; std::getline(maps, line);) {
    const auto start = line.find("liblua");
    if (start != std::string::npos) libraries.insert(line.substr(start));
  }
  REQUIRE(libraries.size() == 1);
  CHECK(libraries.begin()->find("liblua5.4-c++") == 0);
}

TEST_CASE("Lua errors run destructors") {
  struct Mark {
    bool& gone;
    ~Mark() { gone = true; }
  };
  static bool gone = false;
  Bench bench;
  bench.interpreter.library().function({.name = "dotyk.test.mark",
                                        .help = "Marks.",
                                        .example = "dotyk.test.mark()",
                                        .run = [](dotyk::script::Call& call) -> int {
                                          const Mark mark{gone};
                                          return luaL_error(call.state(), "plain error");
                                        }});
  CHECK(bench.error("dotyk.test.mark()") == "t.lua:1: plain error");
  CHECK(gone);
}

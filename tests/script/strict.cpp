#include <doctest/doctest.h>

#include "bench.hpp"

using dotyk::script::Bench;

TEST_CASE("reading a global that was never assigned is an error") {
  Bench bench;
  CHECK(bench.error("x = 3\nprint(y_never)") == "t.lua:2: unknown variable 'y_never'");
  CHECK(bench.error("\nprnit(1)") == "t.lua:2: unknown variable 'prnit', did you mean 'print'?");
  CHECK(bench.error("local block = 3\nlocal y = blok") ==
        "t.lua:2: unknown variable 'blok', did you mean 'block'?");
  CHECK(bench.error("local block = 3\nlocal function f() return block and blok end\nf()") ==
        "t.lua:2: unknown variable 'blok', did you mean 'block'?");
  CHECK(bench.error("z = 3\nassert(z == 3)\nassert(rawget(_G, 'q') == nil)\nassert(_ == nil)") == "");
}

TEST_CASE("dotyk can be required") {
  Bench bench;
  CHECK(bench.error("assert(require 'dotyk' == dotyk)") == "");
}

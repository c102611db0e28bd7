#include <doctest/doctest.h>

#include "bench.hpp"

using dotyk::script::Bench;

namespace {
const std::string made = "local a = dotyk.test.toy{ name = 'a' }\n";
}

TEST_CASE("fields, methods, printing, equality") {
  Bench bench;
  CHECK(bench.error(made + "assert(a.name == 'a' and a.size == 1)\nassert(a:grow(3) == a and a.size == 3)") ==
        "");
  CHECK(bench.error(
            made + "assert(tostring(a) == \"toy 'a'\")\nassert(tostring(dotyk.test.other()) == '<other>')") ==
        "");
  CHECK(bench.error(made + "assert(a ~= dotyk.test.toy{ name = 'a' })\nassert(a.facts.good)") == "");
}

TEST_CASE("wrong use of objects") {
  Bench bench;
  CHECK(bench.error(made + "print(a.nmae)") ==
        "t.lua:2: toy: unknown field or method 'nmae', did you mean 'name'?");
  CHECK(bench.error(made + "a:grwo(2)") ==
        "t.lua:2: toy: unknown field or method 'grwo', did you mean 'grow'?");
  CHECK(bench.error(made + "a.size = 3") == "t.lua:2: toy: its fields cannot be set");
  CHECK(bench.error(made + "a.grow(2)") ==
        "t.lua:2: grow: expected a toy before it, got the number 2 (write toy:grow with a colon, not a dot)");
  CHECK(bench.error(made + "a.grow(dotyk.test.other(), 2)") ==
        "t.lua:2: grow: expected a toy before it, got an other (write toy:grow with a colon, not a dot)");
  CHECK(bench.error(made + "print(a[1])") == "t.lua:2: toy: the number 1 names no field or method of a toy");
  CHECK(bench.error(made + "print(a.facts.siz)") ==
        "t.lua:2: facts: unknown field 'siz', did you mean 'size'?");
  CHECK(bench.error("dotyk.tset.toy{}") == "t.lua:1: dotyk: unknown field 'tset', did you mean 'test'?");
}

TEST_CASE("objects live as long as Lua holds them") {
  Bench bench;
  CHECK(bench.error("dotyk.test.toy{ name = 'gone' } collectgarbage() collectgarbage()") == "");
  REQUIRE(bench.toys.size() == 1);
  CHECK(bench.toys[0].expired());
}

TEST_CASE("a released object says so") {
  Bench bench;
  const auto kept = "local kept\ndo local a <close> = dotyk.test.toy{ name = 'a' } kept = a end\n";
  CHECK(bench.error(std::string(kept) + "kept:grow(2)") == "t.lua:3: toy: this toy was released");
  CHECK(bench.error(std::string(kept) + "print(kept.name)") == "t.lua:3: toy: this toy was released");
  CHECK(bench.error(std::string(kept) + "assert(tostring(kept) == '<released toy>')") == "");
  CHECK(bench.error(std::string(kept) + "dotyk.test.toy{ name = 'b', parent = kept }") ==
        "t.lua:3: toy: 'parent': this toy was released");
}

TEST_CASE("metamethods called on strangers do no harm") {
  Bench bench;
  const auto meta = made + "local meta = debug.getmetatable(a)\n";
  CHECK(bench.error(made + "assert(getmetatable(a) == 'an object of dotyk')") == "");
  CHECK(bench.error(meta + "meta.__gc(io.stdout) meta.__gc(3) meta.__gc(a) meta.__gc(a)") == "");
  CHECK(bench.error(meta + "assert(meta.__eq(io.stdout, 3) == false)") == "");
  CHECK(bench.error(meta + "meta.__index(io.stdout, 'name')") == "t.lua:3: toy: expected a toy, got a FILE*");
  CHECK(bench.error(meta + "meta.__tostring {}") == "t.lua:3: toy: expected a toy, got a table");
}

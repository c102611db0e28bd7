// Every kind of wrong argument, and the text that says so.
#include <doctest/doctest.h>

#include "bench.hpp"

using dotyk::script::Bench;

namespace {
std::string toy(const std::string& keys) { return "dotyk.test.toy{ name = 'a', " + keys + " }"; }
}  // namespace

TEST_CASE("good arguments and fallbacks arrive") {
  Bench bench;
  CHECK(bench.error(toy("")) == "");
  CHECK(bench.text == "red");
  CHECK(bench.numbers == std::vector<double>{0});
  CHECK(bench.error(toy("colour = 'blue', old = true, size = 3")) == "");
  CHECK(bench.text == "blue");
  CHECK(bench.numbers == std::vector<double>{1});
  CHECK(bench.error(toy("at = {1, 2, 3}")) == "");
  CHECK(bench.numbers == std::vector<double>{1, 2, 3});
  CHECK(bench.error(toy("left = { deflection = 4 }")) == "");
  CHECK(bench.numbers == std::vector<double>{4});
  CHECK(bench.error(toy("series = { { name = 'x' }, { name = 'y' } }")) == "");
  CHECK(bench.text == "y");
  CHECK(bench.error("local a, b = dotyk.test.toy{ name = 'a', size = 2 }, dotyk.test.toy{ name = 'b', size = "
                    "5 }\ndotyk.test.box{ a, b }") == "");
  CHECK(bench.numbers == std::vector<double>{2, 5});
}

TEST_CASE("errors carry the line, the callable, and what is wrong") {
  Bench bench;
  const auto says = [&](const std::string& text, const std::string& message) {
    CHECK(bench.error(text) == "t.lua:1: toy: " + message);
  };
  says(toy("clour = 1"), "unknown key 'clour', did you mean 'colour'?");
  says("dotyk.test.toy{ size = 1 }", "missing key 'name' (what it is called), or its value is nil");
  says(toy("size = '3'"), "'size' must be a positive number, got the string \"3\"");
  says(toy("size = -3"), "'size' must be a positive number, got the number -3");
  says(toy("size = 0"), "'size' must be a positive number, got the number 0");
  says(toy("size = 0/0"), "'size' must be a finite number, got nan (not a number)");
  says(toy("size = 1/0"), "'size' must be a finite number, got inf");
  says(toy("size = {}"), "'size' must be a positive number, got a table");
  says(toy("size = print"), "'size' must be a positive number, got a function");
  says(toy("colour = 'gren'"),
       "'colour' must be \"red\", \"green\" or \"blue\", got \"gren\", did you mean \"green\"?");
  says(toy("colour = 3"), "'colour' must be \"red\", \"green\" or \"blue\", got the number 3");
  says(toy("count = 1.5"), "'count' must be an integer of at least 0, got the number 1.5");
  says(toy("count = -1"), "'count' must be an integer of at least 0, got the number -1");
  says(toy("old = 1"), "'old' must be true or false, got the number 1");
  says(toy("at = {1}"), "'at' must be a table of 2 or 3 numbers, got a table of 1");
  says(toy("at = {1, 'x'}"), "'at': entry 2 must be a number, got the string \"x\"");
  says(toy("at = {1, nil, 3}"), "'at': entry 2 must be a number, got nil");
  says(toy("at = {x = 1, 2}"), "'at' must be a table of 2 or 3 numbers, got the key 'x'");
  says(toy("at = 3"), "'at' must be a table of 2 or 3 numbers, got the number 3");
  says(toy("stiffness = {{1, 2}, 3}"), "'stiffness': entry 2 must be a table of numbers, got the number 3");
  says(toy("cells = {2, 0}"), "'cells': entry 2 must be an integer of at least 1, got the number 0");
  says(toy("parent = dotyk.test.other()"), "'parent': expected a toy, got an other");
  says(toy("parent = 3"), "'parent': expected a toy, got the number 3");
  says(toy("left = { deflecton = 4 }"), "'left': unknown key 'deflecton', did you mean 'deflection'?");
  says(toy("left = { deflection = {} }"), "'left': 'deflection' must be a number, got a table");
  says(toy("series = { { name = 'x' }, { nam = 'y' } }"),
       "'series': entry 2: unknown key 'nam', did you mean 'name'?");
  says(toy("error = 'enrgy'"),
       "'error' must be \"energy\" or \"pressure\" or a function, got the string \"enrgy\", did you mean "
       "\"energy\"?");
  says(toy("[1.5] = 2"), "the number 1.5 cannot be a key here");
  says("dotyk.test.toy 'a'",
       "expected a table of keys (name, size, colour, count, old, at, stiffness, cells, weight, parent, "
       "left, series and error), got the string \"a\"");
  says("dotyk.test.toy({ name = 'a' }, 3)", "takes one table of keys, got 2 arguments");
  says("dotyk.test:toy{ name = 'a' }", "write dotyk.test.toy with a dot, not a colon");
}

TEST_CASE("items of a table are counted and checked") {
  Bench bench;
  const auto says = [&](const std::string& text, const std::string& message) {
    CHECK(bench.error("local a = dotyk.test.toy{ name = 'a' } dotyk.test.box" + text) ==
          "t.lua:1: box: " + message);
  };
  says("{ a }", "takes 2 toys, got 1");
  says("{ a, a, a }", "takes 2 toys, got 3");
  says("{ a, 3 }", "item 2: expected a toy, got the number 3");
  says("{ nil, a }", "item 1: expected a toy, got nil (a variable misspelt or not yet set?)");
  says("{ a, a, gapp = 3 }", "unknown key 'gapp', did you mean 'gap'?");
}

TEST_CASE("positional arguments") {
  Bench bench;
  const auto made = std::string("local a = dotyk.test.toy{ name = 'a' }\n");
  CHECK(bench.error(made + "a:grow()") ==
        "t.lua:2: grow: argument 1 'factor' is missing, expected a positive number");
  CHECK(bench.error(made + "a:grow(nil)") ==
        "t.lua:2: grow: argument 1 'factor' is nil (a variable misspelt or not yet set?), expected a "
        "positive number");
  CHECK(bench.error(made + "a:grow(1, 2)") == "t.lua:2: grow: takes 1 argument, got 2");
  CHECK(bench.error(made + "a:grow 'x'") ==
        "t.lua:2: grow: argument 1 'factor' must be a positive number, got the string \"x\"");
}

TEST_CASE("the line is the innermost one of the user") {
  Bench bench;
  CHECK(bench.error(
            "local function make(n)\n  local t = dotyk.test.toy{ name = n }\n  return t\nend\n\nmake(3)") ==
        "t.lua:2: toy: 'name' must be a string, got the number 3");
  CHECK(bench.error("local ok, message = pcall(dotyk.test.toy, {})\nerror(message, 0)") ==
        "t.lua:1: toy: missing key 'name' (what it is called), or its value is nil");
}

TEST_CASE("a metatable cannot smuggle values in, a large table does no harm") {
  Bench bench;
  CHECK(bench.error("dotyk.test.toy(setmetatable({}, { __index = function() error 'called' end }))") ==
        "t.lua:1: toy: missing key 'name' (what it is called), or its value is nil");
  CHECK(bench.error("local t = {} for i = 1, 1e5 do t[i] = { name = 'x' } end\n" + toy("series = t")) == "");
}

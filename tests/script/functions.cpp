// Functions of a script, called from C++.
#include <doctest/doctest.h>

#include "bench.hpp"

using dotyk::script::Bench;

namespace {
std::string weigh(const std::string& function) {
  return "dotyk.test.toy{ name = 'a',\n weight = " + function + " }";
}
}  // namespace

TEST_CASE("a field is a constant or a function") {
  Bench bench;
  CHECK(bench.error(weigh("{3, 4}")) == "");
  CHECK(bench.numbers == std::vector<double>{3, 4});
  CHECK(bench.error(weigh("function(x, y) return x + y, x * y end")) == "");
  CHECK(bench.numbers == std::vector<double>{1.5, 0.5});
  CHECK(bench.error(weigh("{3}")) ==
        "t.lua:1: toy: 'weight' must be a table of 2 numbers or a function, got a table of 1");
  CHECK(bench.error(weigh("3")) ==
        "t.lua:1: toy: 'weight' must be a table of 2 numbers or a function, got a number");
}

TEST_CASE("what a function returns is checked, and the point named") {
  Bench bench;
  const auto says = [&](const std::string& body, const std::string& message) {
    CHECK(bench.error(weigh("function(x, y) " + body + " end")) ==
          "t.lua:1: toy: function 'weight' returned " + message + " at (0.5, 1)");
  };
  says("return 0/0 * x, 1", "nan (not a number)");
  says("return x, math.huge", "inf");
  says("return x", "1 number, expected 2 numbers");
  says("return x, y, 1", "3 numbers, expected 2 numbers");
  says("return 'x', 1", "the string \"x\", expected 2 numbers");
  says("return {x, y}", "a table (write: return fx, fy)");
  says("", "nothing");
}

TEST_CASE("an error inside keeps its line and says where it was called") {
  Bench bench;
  CHECK(bench.error(
            "local f = function(x, y)\n  return nil + x\nend\ndotyk.test.toy{ name = 'a', weight = f }") ==
        "t.lua:2: attempt to perform arithmetic on a nil value (in 'weight' of toy at t.lua:4)");
  CHECK(bench.error("dotyk.test.each(function(k, info) error('no', 0) end)") ==
        "no (in 'f' of each at t.lua:1)");
}

TEST_CASE("error values that are no strings pass unchanged") {
  Bench bench;
  CHECK(bench.error("local mark = {}\nlocal ok, e = pcall(dotyk.test.each, function() error(mark) "
                    "end)\nassert(e == mark)") == "");
}

TEST_CASE("a callback gets its arguments; only false stops") {
  Bench bench;
  CHECK(
      bench.error(
          "assert(dotyk.test.each(function(k, info) assert(k == 1 and info.residual == 0.5) end) == true)") ==
      "");
  CHECK(bench.error("assert(dotyk.test.each(function() return false end) == false)") == "");
}

TEST_CASE("calls work inside coroutines and out of each other") {
  Bench bench;
  CHECK(bench.error("local co = coroutine.wrap(function() dotyk.test.each(function() dotyk.test.toy{ name = "
                    "'x' } end) coroutine.yield(1) end)\nassert(co() == 1)") == "");
  CHECK(bench.error("local co = coroutine.create(function()\n dotyk.test.toy{}\nend)\nlocal ok, message = "
                    "coroutine.resume(co) error(message, 0)") ==
        "t.lua:2: toy: missing key 'name' (what it is called), or its value is nil");
}

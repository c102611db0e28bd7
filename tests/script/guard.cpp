#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/prompt/interrupt.hpp"

using dotyk::script::Bench;

TEST_CASE("C++ exceptions become errors at the user's line") {
  Bench bench;
  CHECK(bench.error("\ndotyk.test.fail 'memory'") == "t.lua:2: fail: out of memory");
  CHECK(bench.error("\n\ndotyk.test.fail 'runtime'") == "t.lua:3: fail: it broke");
  CHECK(bench.error("dotyk.test.fail 'given'") == "t.lua:1: fail: given");
  CHECK(bench.error("assert(not pcall(dotyk.test.fail, 'memory'))\nassert(not pcall(dotyk.test.fail, "
                    "'runtime'))\nassert(1 + 1 == 2)") == "");
}

TEST_CASE("a real failure to allocate is an error, not the end") {
  Bench bench;
  CHECK(bench.error("string.rep('x', 1 << 62)") != "");
  CHECK(bench.error("assert(1 + 1 == 2)") == "");
}

TEST_CASE("endless recursion through C++ ends in an error") {
  Bench bench;
  const auto message = bench.error("local function f() dotyk.test.each(f) end\nf()");
  CHECK(message.find("overflow") != std::string::npos);
  CHECK(bench.error("assert(1 + 1 == 2)") == "");
}

TEST_CASE("a request to stop stops what runs, pcall or not, and is answered once") {
  Bench bench;
  dotyk::script::watch_interrupts(bench.interpreter.state());
  dotyk::script::request_interrupt();
  CHECK(bench.error("while true do pcall(function() while true do end end) end") == "t.lua:1: interrupted");
  dotyk::script::clear_interrupt();
  CHECK(bench.error("for i = 1, 1000 do end") == "");
}

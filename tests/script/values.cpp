// Values as the prompt shows them, by lua/show.lua.
#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/bridge/lua.hpp"
#include "script/bridge/lua_side.hpp"

using namespace dotyk::script;

TEST_CASE("values are shown readably") {
  Bench bench;
  lua_State* L = bench.interpreter.state();
  lua_newtable(L);
  push_own_function(L, "show", "text");
  lua_setfield(L, -2, "text");
  lua_setglobal(L, "shown");
  const auto shows = [&](const std::string& value, const std::string& text) {
    CHECK(bench.error("local text = shown.text(" + value + ")\nif text ~= " + text +
                      " then error(text, 0) end") == "");
  };
  shows("3", "'3'");
  shows("0.1", "'0.1'");
  shows("1/3", "'0.33333333333333'");
  shows("'a b'", "'\"a b\"'");
  shows("'a\\nb'", "'a\\nb'");
  shows("{}", "'{}'");
  shows("{1, 2, x = {3}}", "'{ 1, 2, x = { 3 } }'");
  shows("{[true] = 1, ['a b'] = 2}", "'{ [true] = 1, [\"a b\"] = 2 }'");
  shows("{'a\\nb'}", "'{ \"a\\\\nb\" }'");
  shows("dotyk.test.toy{ name = 'a' }", "\"toy 'a'\"");
  shows("dotyk.test.each", "'dotyk.test.each(f)'");
  shows("dotyk.test.toy{ name = 'a' }.facts", "'{ good = true, size = 1 }'");
  shows("tostring(dotyk.test.toy{ name = 'a' }.facts)", "\"\\\"{ good = true, size = 1 }\\\"\"");
  // One of many numbers has six digits, and so many there are that a person reads them.
  shows("{1/3}", "'{ 0.333333 }'");
  shows("{ x = { 1/3, { 2/3 } } }", "'{ x = { 0.333333, { 0.666667 } } }'");
  CHECK(bench.error("r = setmetatable({}, { __index = function(_, n) local t = {} for i = 1, n do t[i] = i / 7 end return t end })\n"
                    "n = {} for i = 1, 100 do n[i] = { force = i / 3, gap = 1e-5 / 3, normal = { 0, 1 }, pressure = 1e6 / 7, status = 'closed', weight = 1 / 64, x = i / 7 } end") == "");
  shows("{ a = rawget(r, 1) or r[100] }", "'{ a = { 0.142857, 0.285714, 0.428571, 0.571429, 0.714286, 0.857143, … 94 more } }'");
  shows("{ r[3], { 1, 2, 3 } }", "'{ { 0.142857, 0.285714, 0.428571 }, { 1, 2, 3 } }'");
  CHECK(bench.error("local _, lines = shown.text(r[100]):gsub('\\n', '') assert(lines == 4, lines)") == "");
  CHECK(bench.error("local _, lines = shown.text({ max_pressure = 1, nodes = n }):gsub('\\n', '') assert(lines == 9, lines)") == "");
  CHECK(bench.error("local _, lines = shown.text(n):gsub('\\n', '') assert(lines == 31, lines)") == "");
  CHECK(bench.error("local t = {} t.me = t\nassert(shown.text(t) == '{ me = {…} }')") == "");
  CHECK(bench.error("local t = {} for i = 1, 1e5 do t[i] = i end\nassert(#shown.text(t) < 1000)") == "");
}

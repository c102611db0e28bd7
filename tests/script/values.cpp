// Values as the prompt shows them, by lua/show.lua.
#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/lua.hpp"
#include "script/lua_side.hpp"

using namespace dotyk::script;

TEST_CASE("values are shown readably") {
  Bench bench;
  lua_State* L = bench.interpreter.state();
  push_own_module(L, "show");
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
  CHECK(bench.error("local t = {} t.me = t\nassert(shown.text(t) == '{ me = {…} }')") == "");
  CHECK(bench.error("local t = {} for i = 1, 1e5 do t[i] = i end\nassert(#shown.text(t) < 1000)") == "");
}

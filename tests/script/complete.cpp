#include <doctest/doctest.h>

#include <algorithm>

#include "bench.hpp"
#include "script/complete/complete.hpp"
#include "script/complete/complete_context.hpp"

using namespace dotyk::script;

namespace {
using Words = std::vector<std::string>;
}

TEST_CASE("completion offers what fits") {
  Bench bench;
  REQUIRE(bench.error(
              "a = dotyk.test.toy{ name = 'a' }\nt = { alpha = 1, beta = { gamma = 2 } }\ns = 'text'") == "");
  const auto words = [&](const std::string& text) { return complete(bench.interpreter.state(), text).words; };
  CHECK(words("dotyk.te") == Words{"test"});
  CHECK(words("x = dotyk.test.") == Words{"box", "each", "fail", "other", "toy"});
  CHECK(words("t.beta.g") == Words{"gamma"});
  CHECK(words("a.") == Words{"facts", "name", "size"});
  CHECK(words("a.facts.") == Words{"good", "size"});
  CHECK(words("a:") == Words{"grow", "part"});
  CHECK(words("s:upp") == Words{"upper"});
  CHECK(words("print(a:gr") == Words{"grow"});
  CHECK(words("dotyk.test.toy{ name = 'b' }:") == Words{"grow", "part"});
  CHECK(words("a:grow(2):grow(3).si") == Words{"size"});
  CHECK(words("unknown_thing.").empty());
  CHECK(words("-- dotyk.").size() >= 0);
}

TEST_CASE("completion of what is no Lua") {
  Bench bench;
  const auto words = [&](const std::string& text) { return complete(bench.interpreter.state(), text).words; };
  CHECK(words("%ti") == Words{"time "});
  CHECK(words("%") == Words{"time "});
  CHECK(words("%x").empty());
  CHECK(words("%time dotyk.te") == Words{"test"});
  CHECK(words("5 %ti").empty());
  CHECK(words("help \"prom") == Words{"prompt"});
}

TEST_CASE("completion inside a table argument") {
  Bench bench;
  const auto words = [&](const std::string& text) { return complete(bench.interpreter.state(), text).words; };
  CHECK(words("dotyk.test.toy{ na") == Words{"name = "});
  CHECK(words("local b = dotyk.test.toy{\n  name = 'x', si") == Words{"size = "});
  CHECK(words("dotyk.test.toy{ left = { de") == Words{"deflection = "});
  CHECK(words("dotyk.test.toy({ na") == Words{"name = "});
  CHECK(words("dotyk.test.toy{ series = { { na") == Words{"name = "});
  CHECK(words("dotyk.test.toy{ colour = \"") == Words{"blue", "green", "red"});
  CHECK(words("dotyk.test.toy{ colour = 'gr") == Words{"green"});
  CHECK(words("dotyk.test.toy{ error = 'en") == Words{"energy"});
  CHECK(words("dotyk.test.toy{ size = prin") == Words{"print"});
  CHECK(words("dotyk.test.box{ ") == Words{"dotyk.test.toy", "gap = "});
  // an item that is an object or a table, and a list that is one of several kinds
  CHECK(words("dotyk.work_precision{ methods = { { ") == Words{"method = ", "name = "});
  CHECK(words("dotyk.work_precision{ methods = { dotyk.solver.pdas{}, { na") == Words{"name = "});
  CHECK(words("dotyk.work_precision{ methods = { { method = dotyk.solver.pd") == Words{"pdas"});
  CHECK(words("dotyk.work_precision{ levels = { ").size() > 20);
  CHECK(words("dotyk.work_precision{ error = { ").size() > 20);
  CHECK(words("dotyk.solve(dotyk.test.other(), {\n") == words("dotyk.solve(dotyk.test.other(), {"));
  CHECK(words("help 'toy:") == Words{"toy:grow", "toy:part"});
  CHECK(words("help(\"dotyk.refe") == Words{"dotyk.reference"});
  CHECK(complete(bench.interpreter.state(), "io.open('/et").file_names);
  CHECK(complete(bench.interpreter.state(), "dotyk.qp{ file = 'x").file_names);
  CHECK(complete(bench.interpreter.state(), "dotyk.qp 'x").file_names);
  CHECK(!complete(bench.interpreter.state(), "dotyk.test.toy{ name = 'x").file_names);
}

TEST_CASE("completion offers after a dot, and for a variable, only what is a name") {
  Bench bench;
  REQUIRE(bench.error("t = { ['two words'] = 1, ['end'] = 2, two = 3 } _G['two words'] = t _G['a toy'] = dotyk.test.toy{ name = 'a' }") == "");
  const auto words = [&](const std::string& text) { return complete(bench.interpreter.state(), text).words; };
  CHECK(words("t.") == Words{"two"});
  CHECK(words("t['t") == Words{"two", "two words"});
  CHECK(words("tw").empty());
  CHECK(words("en") == Words{"end"});
  CHECK(words("dotyk.test.toy{ parent = ") == Words{"dotyk.test.toy"});
}

TEST_CASE("completion of what a key or an argument may be") {
  Bench bench;
  REQUIRE(bench.error("a = dotyk.test.toy{ name = 'a' } b = dotyk.test.toy{ name = 'b' } t = { a, { x = b } }") == "");
  const auto words = [&](const std::string& text) { return complete(bench.interpreter.state(), text).words; };
  CHECK(words("dotyk.test.toy{ colour = ") == Words{"\"blue\"", "\"green\"", "\"red\""});
  CHECK(words("dotyk.test.toy{ old = ") == Words{"false", "true"});
  CHECK(words("dotyk.test.toy{ parent = ") == Words{"a", "b"});
  CHECK(words("dotyk.test.toy{ parent = dotyk.test.toy{ colour = 'r") == Words{"red"});
  CHECK(words("dotyk.test.box{ a, ") == Words{"a", "b", "gap = "});
  CHECK(words("dotyk.test.toy{ size = 2 * ").size() > 20);
  CHECK(words("print(") == words("print(1, "));
  // an index: a plain one is followed
  CHECK(words("t[1].si") == Words{"size"});
  CHECK(words("t[2].x:") == Words{"grow", "part"});
  CHECK(words("t[\"n") == Words{});
  CHECK(words("t[2][\"") == Words{"x"});
  CHECK(words("t[2]['x'].na") == Words{"name"});
  CHECK(words("t[1 + 0].").empty());
  CHECK(words("a['fa") == Words{"facts"});
  CHECK(words("('x'):re").empty());
}

TEST_CASE("completion of names that a method's object brings") {
  Bench bench;
  REQUIRE(bench.error("a = dotyk.test.toy{ name = 'a' } t = { a }") == "");
  const auto found = [&](const std::string& text) { return complete(bench.interpreter.state(), text); };
  const auto words = [&](const std::string& text) { return found(text).words; };
  const Words all{"a's head", "a's tail"};
  CHECK(words("a:part \"") == all);
  CHECK(words("a:part('") == all);
  CHECK(words("x = { y = a:part(\"a's t") == Words{"a's tail"});
  CHECK(words("f(1, { k = 2, t[1]:part \"") == all);
  CHECK(words("for i = 1, 2 do\n  a:part(") == Words{"\"a's head\"", "\"a's tail\""});
  CHECK(words("a:part('x', '") == Words{"far", "near"});
  CHECK(words("a:part('x', ") == Words{"\"far\"", "\"near\""});
  CHECK(words("dotyk.test.toy{ name = 'b' }:part \"").empty());  // made when it runs
  CHECK(found("a:part \"").quote == '"');
  CHECK(found("a:part(").quote == 0);
  CHECK(found("io.open '").quote == 0);
  CHECK(!found("a:part \"").file_names);
  REQUIRE(bench.error("do local released <close> = a end") == "");
  CHECK(words("a:part \"").empty());  // released
}

TEST_CASE("reading unfinished code never stumbles") {
  const std::string code =
      "local x <const> = f{ a = { 1, 'x\\'', [[ long ]] }, b = g(1).c:d \"s\" } -- end\nfor i = 1, 2 do t[i] "
      "= ..5 ::l:: end }}]) '";
  for (std::size_t length = 0; length <= code.size(); ++length) {
    const auto context = read_context(code.substr(0, length));
    CHECK(context.start <= length);
  }
}

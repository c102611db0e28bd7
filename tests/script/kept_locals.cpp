// Local variables that outlive their chunk: of a line typed at the prompt, of a script before it.
#include <doctest/doctest.h>

#include "bench.hpp"
#include "script/help/help.hpp"
#include "script/prompt/kept_locals.hpp"

using namespace dotyk::script;

TEST_CASE("what is declared at the beginning of an input is global") {
  CHECK(as_globals("local x = 3") == "      x = 3");
  CHECK(as_globals("local x <const> = 3") == "      x         = 3");
  CHECK(as_globals("-- why\nlocal a <const>, b< const >=f()") == "-- why\n      a        , b         =f()");
  CHECK(as_globals("local function f() local y <const> = 1 end") == "      function f() local y         = 1 end");
  for (const char* text : {"local x", "local x, y", "local f <close> = open()", "locals = 3", "f('local x = 1')", "x = [[local y <const> = 2]]",
                           "-- local x = 1", "--[[ local x = 1 ]] y = 2", "do local x = 1 end", "local x == 2", "local", ""})
    CHECK(as_globals(text) == text);
}

TEST_CASE("locals of a script stay, whatever ends it") {
  Bench bench;
  bench.interpreter.keep_locals();
  const auto prompt = [&](const std::string& text) { return bench.interpreter.run_text(text, "prompt").value_or(""); };
  CHECK(bench.error("local a <const>, b <const> = 3, 'x'\nlocal function f() return a end\nlocal function g() local n <const> = a return n end\n"
                    "local none\ndo local inner = 1 end\nlocal t <const> = { b }\nlocal file <close> = setmetatable({}, { __close = function() closed = true end })") == "");
  CHECK(prompt("assert(a == 3 and b == 'x' and t[1] == 'x' and f() == 3 and g() == 3 and none == nil and closed)") == "");
  CHECK(prompt("print(inner)").find("unknown variable 'inner'") != std::string::npos);
  CHECK(prompt("print(file)").find("unknown variable 'file'") != std::string::npos);
  CHECK(bench.error("local early <const> = 1\nif early then return end\nlocal late = 2") == "");
  CHECK(prompt("assert(early == 1 and rawget(_G, 'late') == nil)") == "");
  CHECK(bench.error("local before <const> = 7\nlocal function deep() local hidden = 1 error 'oh' end\nfor i = 4, 5 do deep() end\nlocal after = 1") == "t.lua:2: oh");
  CHECK(prompt("assert(before == 7 and i == 4 and not rawget(_G, 'hidden') and not rawget(_G, 'after'))") == "");
  CHECK(bench.error("local deepest <const> = 8\nlocal function f() return 1 + f() end f()").find("stack overflow") != std::string::npos);
  CHECK(prompt("assert(deepest == 8)") == "");
  CHECK(bench.error("local x <const> = 1 x = 2") == "t.lua:1: attempt to assign to const variable 'x'");
  CHECK(bench.error("return select('#', ...)") == "");
  CHECK(prompt("assert(not rawget(_G, '__keep_locals'))") == "");
  // names of Lua's own: what dotyk has written in Lua does not notice
  CHECK(bench.error("local type <const>, table <const>, next <const> = 1, 2, 3") == "");
  CHECK(prompt("source(dotyk.adapt)") == "");
}

TEST_CASE("every function and object is listed by help(), once") {
  Bench bench;
  const auto& library = bench.interpreter.library();
  const auto index = help_index(library);
  const auto count = [&](const std::string& text) {
    std::size_t found = 0;
    for (auto at = index.find(text); at != std::string::npos; at = index.find(text, at + 1)) ++found;
    return found;
  };
  for (const auto& one : library.functions())
    if (one.name.rfind("dotyk.dual.", 0) != 0) CHECK_MESSAGE(count("\n  " + one.name + " ") == 1, one.name);
  std::size_t start = 0;
  for (auto end = index.find('\n'); end != std::string::npos; start = end + 1, end = index.find('\n', start)) {
    std::size_t letters = 0;
    for (auto k = start; k < end; ++k) letters += (index[k] & 0xc0) != 0x80;
    CHECK_MESSAGE(letters <= 100, index.substr(start, end - start));
  }
  CHECK(count("The rest:\n  help ") == 1);
  CHECK(count("dotyk.test.toy") == 1);  // what no group names is among the rest
  for (const char* word : {"x?", "%time", "  _ ", "Tab", "Ctrl-R", "Ctrl-C", "source(f)", "dotyk.reference()"}) CHECK_MESSAGE(count(word) >= 1, word);
  CHECK(index.size() - index.find("At the prompt:") == help_on_prompt().size());
}

// What people type at a prompt that is not Lua.
#include <doctest/doctest.h>

#include "script/prompt/prompt.hpp"

using namespace dotyk::script;

TEST_CASE("a question mark, or help and a name, asks for help") {
  const auto asked = [](const std::string& input) {
    return question(input, [](const std::string& name) { return name == "block" || name == "dotyk"; });
  };
  CHECK(asked("block?") == "help(block)");
  CHECK(asked("?block") == "help(block)");
  CHECK(asked(" help  block ") == "help(block)");
  CHECK(asked("block:part?") == "help(block.part)");
  CHECK(asked("dotyk.solver.pdas ?") == "help(dotyk.solver.pdas)");
  CHECK(asked("dotyk.adapt??") == "source(dotyk.adapt)");
  CHECK(asked("pdas?") == "help \"pdas\"");
  CHECK(asked("help body:part") == "help \"body:part\"");
  for (const char* lua : {"help(block)", "help 'block'", "help", "block", "x = 1 -- why?", "f('?')", "?", "", "block.?", "helpful = 1"})
    CHECK(asked(lua) == "");
}

TEST_CASE("leaving") {
  for (const char* input : {"exit", "quit", "exit()", " quit ( ) ;"}) CHECK(wants_out(input));
  for (const char* input : {"exits", "quit(1)", "print(exit)", ""}) CHECK(!wants_out(input));
}

TEST_CASE("pasted lines") {
  using Lines = std::deque<std::string>;
  CHECK(lines_of("a") == Lines{"a"});
  CHECK(lines_of("") == Lines{""});
  CHECK(lines_of("a\n\n b\n") == Lines{"a", "", " b"});
  for (const char* line : {"  :load{ 0, -1 }", ".x", "+ 1", "or 2", "}", "..  'x'", "== 3"}) CHECK(goes_on_with(line));
  for (const char* line : {"", "x = 1", "::label::", "order = 2", "-- remark", "(f or g)()", "orders()"}) CHECK(!goes_on_with(line));
}

#pragma once
// What people type at a prompt that is not Lua, as Lua.
#include <deque>
#include <functional>
#include <string>

namespace dotyk::script {

// "exit" and "quit", called or not.
bool wants_out(const std::string& input);

// "block?", "?block" and "help block" as help(block), "f??" as source(f); also
// with a method of it, after a dot or a colon. What does not begin with a
// variable goes to help as a string: "pdas?" is help "pdas". Other input: "".
std::string question(const std::string& input, const std::function<bool(const std::string&)>& is_variable);

// At least one; pasted text has several.
std::deque<std::string> lines_of(const std::string& text);

// Does the line belong to the one before, complete as that may look? It begins
// with what begins no statement: ":load{ 0, -1 }", "+ 1", "}".
bool goes_on_with(const std::string& line);

}  // namespace dotyk::script

#pragma once
// The prompt, and what people type there that is not Lua, as Lua.
#include <deque>
#include <functional>
#include <string>

namespace dotyk::script {

class Interpreter;

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

// Reads, runs and shows until the end of input. With a terminal: line editing,
// history, completion. Without one: the same, plainly. Returns an exit status:
// 1 when input from a pipe had an error, else 0.
int run_prompt(Interpreter& interpreter);

}  // namespace dotyk::script

#pragma once
namespace dotyk::script {

class Interpreter;

// Reads, runs and shows until the end of input. With a terminal: line editing,
// history, completion. Without one: the same, plainly. Returns an exit status:
// 1 when input from a pipe had an error, else 0.
int run_prompt(Interpreter& interpreter);

}  // namespace dotyk::script

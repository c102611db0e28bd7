#pragma once
// Ctrl-C. The first raises the Lua error "interrupted" at the next instruction
// of the script and is seen by long computations that poll interrupted(); a
// second, while the first is still unanswered, ends the program.
// At the prompt a second only says that the next one will, for two seconds.
struct lua_State;

namespace dotyk::script {

// Has the user asked to stop? Stays true until the request is answered.
bool interrupted();

// The request was answered. Instructions are counted anew.
void clear_interrupt();

// The request was answered by a result so far, with which the input typed goes on, until clear_interrupt.
void answer_interrupt();

// Was it? Then long work that would begin now is one too many: a loop of solves is to end.
bool interrupt_answered();

// For what computes long without running Lua.
void raise_if_interrupted(lua_State* L);

// Ctrl-C ends the program from now on.
void leave_interrupts();

// From now on the user has a session to lose: Ctrl-C does not end the program without a warning.
void keep_session();

// Asks to stop, as Ctrl-C does.
void request_interrupt();

// From now on at most `count` instructions of Lua: then every one raises, in every coroutine, so that
// no pcall, xpcall or __close of the script goes on. As Lua runs __gc without hooks, setmetatable refuses
// it. What C++ does meanwhile (a solve, a pattern search) counts for nothing. After watch_interrupts.
void limit_instructions(lua_State* L, long long count);

// From now on Ctrl-C interrupts what runs in this state (and in its
// coroutines). Called once a program.
void watch_interrupts(lua_State* L);

}  // namespace dotyk::script

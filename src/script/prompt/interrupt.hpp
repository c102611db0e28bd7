#pragma once
// Ctrl-C. The first raises the Lua error "interrupted" at the next instruction
// of the script and is seen by long computations that poll interrupted(); a
// second, while the first is still unanswered, ends the program.
// At the prompt a second only says that the next one will, for two seconds.
#include <cstdint>

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

// Work in Lua's library that can be left anywhere on Ctrl-C: does it, and true; or false where it was left, or not begun
// because Ctrl-C came before. What it has in hand is then lost, so it may change nothing but memory that the caller gives up
// whole: a Lua state of its own. It is left only while the processor is in the library's own code (let_abandon), never in the
// C library, which may hold a lock, nor in dotyk; where that cannot be told (other processors), it is not left.
bool abandonable(void (*work)(void*), void* data);

// The library that has the function at this address.
void let_abandon(std::uintptr_t function);

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

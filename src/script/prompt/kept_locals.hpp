#pragma once
// Local variables of a chunk that outlive it as the prompt's: of what is typed there, and of a script before it (-i).
#include <string>

struct lua_State;

namespace dotyk::script {

// Puts in the place of the function on top of the stack, which the text compiled to, one that, run next, leaves the
// variables of its outermost block as global ones, whether it returns or ends with an error (see keep_locals_after_error).
// <const> is dropped: constants are in no register, so nobody could read them. What is <close> is closed and forgotten.
// Returns the text that it is of: the same, with the function, where there is no room for one variable more.
std::string keep_locals(lua_State* L, const std::string& text, const std::string& name);

// In a message handler, where the frames still stand: keeps what keep_locals' last function has so far.
void keep_locals_after_error(lua_State* L);

// The text of an input without "local" at its beginning, where that declares what is given a value: functions of the
// same input then share the variable with what is typed later. And without <const>.
std::string as_globals(const std::string& text);

}  // namespace dotyk::script

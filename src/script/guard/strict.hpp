#pragma once
// Reading a global that was never assigned is an error with the nearest name.
struct lua_State;

namespace dotyk::script {

// Assigning globals stays allowed. `_`, the prompt's last result, may be read
// before there is one; rawget(_G, name) asks without an error.
void make_globals_strict(lua_State* L);

// From now on the global may be read while it is nil: `local x` at the prompt.
void declare_global(lua_State* L, const char* name);

}  // namespace dotyk::script

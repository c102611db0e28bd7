#pragma once
// Functions of Lua's own libraries that would run for ever beyond the reach of Ctrl-C, or let a script break what C++
// relies on, replaced by ones that do the same and do not.
#include <initializer_list>

#include "script/bridge/lua.hpp"

namespace dotyk::script {

// A function of Lua's own, LIBRARY.NAME, and the one that takes its place: it looks first, and then mostly calls original().
struct Replacement {
  const char *library, *name;
  lua_CFunction function;
};

// That of the table on top of the stack. What it was is the function's upvalue 1, its name upvalue 2. Once for each field.
inline void replace_field(lua_State* L, const char* name, lua_CFunction function) {
  lua_getfield(L, -1, name);
  lua_pushstring(L, name);
  lua_pushcclosure(L, function, 2);
  lua_setfield(L, -2, name);
}

inline void replace(lua_State* L, std::initializer_list<Replacement> all) {
  for (const auto& [library, name, function] : all) {
    lua_getglobal(L, library);
    replace_field(L, name, function);
    lua_pop(L, 1);
  }
}

// Calls the function that the running one has replaced. No stack frame lies between, so that its error messages name the script's line.
inline int original(lua_State* L) { return lua_tocfunction(L, lua_upvalueindex(1))(L); }

// Patterns (guard_patterns); string.rep of nothing; table.move, insert and remove over any number of places; of debug what
// would change functions and values that are not written in Lua, which is refused, or look into them, which finds nothing;
// load, loadfile, dofile and require of compiled chunks, which are refused: a wrong one ends the program.
void guard_lua(lua_State* L);

// string.find, match, gmatch and gsub: the same as Lua's, whose matching is one call of C, but Ctrl-C can stop them.
void guard_patterns(lua_State* L);

// From now on reading a global that was never assigned is an error with the nearest name. Assigning stays allowed. `_`, the prompt's last result, may be read
// before there is one; rawget(_G, name) asks without an error.
void make_globals_strict(lua_State* L);

// From now on the global may be read while it is nil: `local x` at the prompt.
void declare_global(lua_State* L, const char* name);

}  // namespace dotyk::script

#pragma once
// Functions of Lua's own libraries that dotyk replaces by ones that look first, and then mostly call them.
#include <initializer_list>

#include "script/bridge/lua.hpp"

namespace dotyk::script {

// LIBRARY.NAME, and what it becomes.
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

// Calls what the running function was, in this very frame: its messages name the script's line.
inline int original(lua_State* L) { return lua_tocfunction(L, lua_upvalueindex(1))(L); }

}  // namespace dotyk::script

#include "script/guard/strict.hpp"

#include <stdexcept>

#include "script/bridge/position.hpp"
#include "script/bridge/lua.hpp"
#include "script/help/nearest.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {
namespace {

// The names in reach of the running function that are no globals: a typing
// slip is as likely in those.
void add_locals(lua_State* L, std::vector<std::string>& names) {
  lua_Debug frame;
  if (!lua_getstack(L, 1, &frame)) return;
  const auto add = [&](const char* name) {
    lua_pop(L, 1);
    if (name[0] != '\0' && name[0] != '(') names.emplace_back(name);
  };
  for (int i = 1; const char* name = lua_getlocal(L, &frame, i); ++i) add(name);
  lua_getinfo(L, "f", &frame);
  for (int i = 1; const char* name = lua_getupvalue(L, -1, i); ++i) add(name);
  lua_pop(L, 1);
}

constexpr char declared[] = "dotyk.declared";  // in the registry: NAME = true

bool is_declared(lua_State* L, const char* name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, declared);
  lua_getfield(L, -1, name);
  const bool is = lua_toboolean(L, -1);
  lua_pop(L, 2);
  return is;
}

int unknown_global(lua_State* L) {
  return guarded(L, "", [L]() -> int {
    if (lua_type(L, 2) != LUA_TSTRING || std::string(lua_tostring(L, 2)) == "_" || is_declared(L, lua_tostring(L, 2))) {
      lua_pushnil(L);
      return 1;
    }
    const std::string name = lua_tostring(L, 2);
    auto known = string_keys(L, 1);
    add_locals(L, known);
    const auto near = nearest(name, known);
    throw std::runtime_error("unknown variable '" + name + "'" +
                             (near.empty() ? "" : ", did you mean '" + near + "'?"));
  });
}

}  // namespace

void make_globals_strict(lua_State* L) {
  lua_pushglobaltable(L);
  lua_newtable(L);
  set_field(L, "__index", unknown_global);
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

void declare_global(lua_State* L, const char* name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, declared);
  set_field(L, name, true);
  lua_pop(L, 1);
}

}  // namespace dotyk::script

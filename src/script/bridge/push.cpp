#include "script/bridge/push.hpp"

#include <algorithm>

#include "script/bridge/position.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

int unknown_field(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(1));
  if (lua_type(L, 2) != LUA_TSTRING) {
    lua_pushnil(L);
    return 1;
  }
  if (luaL_getmetafield(L, 1, "__absent") != LUA_TNIL) {
    lua_pushvalue(L, 2);
    if (lua_rawget(L, -2) != LUA_TNIL) {
      lua_pushnil(L);
      return 1;
    }
  }
  const auto known = string_keys(L, 1);
  raise(L, name, unknown_name("field", lua_tostring(L, 2), known));
}

int show_table(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  push_own_module(L, "show");
  lua_getfield(L, -1, "text");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return 1;
}

}  // namespace

std::vector<std::string> string_keys(lua_State* L, int index) {
  std::vector<std::string> names;
  index = lua_absindex(L, index);
  luaL_checkstack(L, 4, nullptr);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void make_strict(lua_State* L, const std::string& name) {
  const auto registered = "dotyk.strict." + name;
  if (luaL_newmetatable(L, registered.c_str())) {
    push(L, name);
    lua_setfield(L, -2, "__name");
    push(L, name);
    lua_pushcclosure(L, unknown_field, 1);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, show_table);
    lua_setfield(L, -2, "__tostring");
    push(L, true);
    lua_setfield(L, -2, "__strict");  // lua/show.lua looks inside these
  }
  lua_setmetatable(L, -2);
}

void push(lua_State* L, const Record& record) {
  luaL_checkstack(L, 6, nullptr);
  lua_createtable(L, 0, static_cast<int>(record.entries.size()));
  for (const auto& entry : record.entries) {
    std::visit([L](const auto& value) { push(L, value); }, entry.value);
    lua_setfield(L, -2, entry.name.c_str());
  }
  if (record.name.empty()) return;
  make_strict(L, record.name);
  if (record.absent.empty()) return;
  lua_getmetatable(L, -1);  // of all records of this name
  if (lua_getfield(L, -1, "__absent") == LUA_TNIL) {
    lua_pop(L, 1);
    lua_createtable(L, 0, static_cast<int>(record.absent.size()));
  }
  for (const auto& name : record.absent) {
    push(L, true);
    lua_setfield(L, -2, name.c_str());
  }
  lua_setfield(L, -2, "__absent");
  lua_pop(L, 1);
}

}  // namespace dotyk::script

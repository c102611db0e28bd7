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
  push_own_function(L, "show", "text");
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
    set_field(L, "__name", name);
    push(L, name);
    lua_pushcclosure(L, unknown_field, 1);
    lua_setfield(L, -2, "__index");
    set_field(L, "__tostring", show_table);
    set_field(L, "__strict", true);  // lua/show.lua looks inside these
  }
  lua_setmetatable(L, -2);
}

Record& Record::add(const std::vector<Entry>& more) {
  entries.insert(entries.end(), more.begin(), more.end());
  return *this;
}

void push(lua_State* L, const Record& record) {
  luaL_checkstack(L, 6, nullptr);
  lua_createtable(L, 0, static_cast<int>(record.entries.size()));
  for (const auto& entry : record.entries)
    std::visit([&](const auto& value) { set_field(L, entry.name.c_str(), value); }, entry.value);
  if (record.name.empty()) return;
  make_strict(L, record.name);
  lua_getmetatable(L, -1);  // of all records of this name
  luaL_getsubtable(L, -1, "__absent");
  for (const auto& entry : record.entries)
    if (entry.value.index() == 0) set_field(L, entry.name.c_str(), true);
  lua_pop(L, 2);
}

}  // namespace dotyk::script

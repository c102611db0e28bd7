#include "script/bridge/push.hpp"

#include <stdexcept>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

// A script may call metamethods with any values, or move them into other metatables, so each checks what it gets.
// Upvalue 1 of release and equal is the type's name.
Holder* holder_at(lua_State* L, int index) { return object_at(L, index, lua_tostring(L, lua_upvalueindex(1))); }

int release(lua_State* L) {
  if (auto* holder = holder_at(L, 1)) holder->pointer.reset();
  return 0;
}

int equal(lua_State* L) {
  const auto *a = holder_at(L, 1), *b = holder_at(L, 2);
  lua_pushboolean(L, a && b && a->pointer == b->pointer);
  return 1;
}

// Gives nothing, which is nil, where there is no error.
int unknown_field(lua_State* L) {
  if (lua_type(L, 2) != LUA_TSTRING) return 0;
  if (luaL_getmetafield(L, 1, "__absent") == LUA_TTABLE) {
    lua_pushvalue(L, 2);
    if (lua_rawget(L, -2) != LUA_TNIL) return 0;
  }
  raise(L, lua_tostring(L, lua_upvalueindex(1)), unknown_name("field", lua_tostring(L, 2), string_keys(L, 1)));
}

int show_table(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  push_own_function(L, "show", "text");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return 1;
}

}  // namespace

void push_object(lua_State* L, std::shared_ptr<void> pointer, const char* type) {
  luaL_checkstack(L, 4, nullptr);
  auto* place = lua_newuserdatauv(L, sizeof(Holder), 1);
  new (place) Holder{std::move(pointer)};
  if (luaL_getmetatable(L, type) == LUA_TNIL) {
    static_cast<Holder*>(place)->~Holder();
    throw std::logic_error(std::string("type '") + type + "' was never registered");
  }
  lua_setmetatable(L, -2);
}

Holder* object_at(lua_State* L, int index, const char* type) {
  return static_cast<Holder*>(luaL_testudata(L, index, type));
}

std::shared_ptr<void> checked_object(lua_State* L, int index, const char* type) {
  const auto* holder = object_at(L, index, type);
  if (!holder) throw std::runtime_error("expected " + with_article(type) + ", got " + describe_value(L, index));
  if (!holder->pointer) throw std::runtime_error(std::string("this ") + type + " was released");
  return holder->pointer;
}

void add_object_metamethods(lua_State* L, const std::string& type) {
  for (const auto& [event, function] : {luaL_Reg{"__gc", release}, {"__close", release}, {"__eq", equal}}) {
    push(L, type);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, event);
  }
  set_field(L, "__metatable", "an object of dotyk");
}

std::string meta_text(lua_State* L, int index, const char* field) {
  if (luaL_getmetafield(L, index, field) == LUA_TNIL) return "";
  const std::string text = lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return text;
}

std::vector<std::string> string_keys(lua_State* L, int index) {
  std::vector<std::string> names;
  if (!lua_istable(L, index)) return names;
  index = lua_absindex(L, index);
  luaL_checkstack(L, 4, nullptr);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(L, -2));
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
  for (const auto& entry : record.entries) {
    entry.push_value(L);
    lua_setfield(L, -2, entry.name.c_str());
  }
  if (record.name.empty()) return;
  make_strict(L, record.name);
  lua_getmetatable(L, -1);  // of all records of this name
  luaL_getsubtable(L, -1, "__absent");
  for (const auto& entry : record.entries)
    if (entry.absent) set_field(L, entry.name.c_str(), true);
  lua_pop(L, 2);
}

}  // namespace dotyk::script

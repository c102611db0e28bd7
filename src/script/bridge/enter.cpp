#include "script/bridge/enter.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/library.hpp"
#include "script/guard/manifest.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

// Puts the absent keys' fallbacks into the table at index.
void fill_in(lua_State* L, int index, const Key& table) {
  for (const auto& key : table.keys) {
    lua_getfield(L, index, key.name.c_str());
    const bool absent = lua_isnil(L, -1);
    lua_pop(L, 1);
    if (!absent || std::holds_alternative<std::monostate>(key.default_value)) continue;
    const auto* number = std::get_if<double>(&key.default_value);
    if (number && key.kind == Kind::integer) push(L, static_cast<lua_Integer>(*number));
    else std::visit([L](const auto& value) { push(L, value); }, key.default_value);
    lua_setfield(L, index, key.name.c_str());
  }
}

// A callable written in Lua, called with the checked arguments.
int run_lua(lua_State* L, const Descriptor& descriptor) {
  const int given = lua_gettop(L);
  { const Call call(L, descriptor); }
  const int first = descriptor.owner().empty() ? 1 : 2;
  lua_settop(L, descriptor.takes_table() ? first : given);
  if (descriptor.takes_table()) {
    lua_newtable(L);
    for (lua_pushnil(L); lua_next(L, first);) {
      lua_pushvalue(L, -2);
      lua_insert(L, -2);
      lua_rawset(L, -4);
    }
    fill_in(L, lua_gettop(L), descriptor.arguments[0]);
    lua_replace(L, first);
  }
  push_own_function(L, descriptor.in_lua.file.c_str(), descriptor.in_lua.name.c_str());
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

// The files that the call is to write, as far as they are named.
std::vector<std::string> output_files(const Call& call) {
  std::vector<std::string> out;
  for (const auto& key : call.descriptor().keys())
    if (key.output && call.has(key.name) && !call.text(key.name).empty()) out.push_back(call.text(key.name));
  return out;
}

// Before the call, so that no file is left without its manifest.
void require_manifests(const Call& call) {
  for (const auto& file : output_files(call)) Manifest::require_place(call.state(), file);
}

// Beside every file that the call has written.
void write_manifests(const Call& call) {
  const auto& descriptor = call.descriptor();
  for (const auto& file : output_files(call))
    if (std::filesystem::exists(file)) Library::of(call.state()).manifest->write(call.state(), file, descriptor.name, descriptor.owner().empty() ? 0 : 1);
}

int enter(lua_State* L) {
  const auto& descriptor = *static_cast<const Descriptor*>(lua_touserdata(L, lua_upvalueindex(1)));
  return guarded(L, descriptor.short_name(), [&] {
    if (!descriptor.run) return run_lua(L, descriptor);
    Call call(L, descriptor);
    const bool manifest = Library::of(L).manifest != nullptr;
    if (manifest) require_manifests(call);
    const int results = descriptor.run(call);
    if (manifest) write_manifests(call);
    return results;
  });
}

const Type& type_upvalue(lua_State* L) {
  return *static_cast<const Type*>(lua_touserdata(L, lua_upvalueindex(1)));
}

int index_object(lua_State* L) {
  const auto& type = type_upvalue(L);
  return guarded(L, type.name, [&] {
    const auto object = checked_object(L, 1, type.name.c_str());
    if (lua_type(L, 2) != LUA_TSTRING)
      throw ArgumentError(describe_value(L, 2) + " names no field or method of " + with_article(type.name));
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    const std::string name = lua_tostring(L, 2);
    const auto* field = type.field(name);
    if (!field) throw ArgumentError(unknown_name("field or method", name, type.member_names()));
    field->read(L, object);
    return 1;
  });
}

int set_object(lua_State* L) {
  const auto& type = type_upvalue(L);
  raise(L, type.name, "its fields cannot be set");
}

int show_object(lua_State* L) {
  const auto& type = type_upvalue(L);
  return guarded(L, type.name, [&] {
    const auto* holder = object_at(L, 1, type.name.c_str());
    if (!holder) throw ArgumentError("expected " + with_article(type.name) + ", got " + describe_value(L, 1));
    if (!holder->pointer) push(L, "<released " + type.name + ">");
    else push(L, type.text ? type.text(holder->pointer.get()) : "<" + type.name + ">");
    return 1;
  });
}

void set_closure(lua_State* L, const Type& type, const char* event, lua_CFunction function) {
  lua_pushlightuserdata(L, const_cast<Type*>(&type));
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, event);
}

}  // namespace

void push_function(lua_State* L, const Descriptor& descriptor) {
  lua_pushlightuserdata(L, const_cast<Descriptor*>(&descriptor));
  lua_pushcclosure(L, enter, 1);
}

const Descriptor* descriptor_at(lua_State* L, int index) {
  if (lua_tocfunction(L, index) != enter || !lua_getupvalue(L, index, 1)) return nullptr;
  const auto* descriptor = static_cast<const Descriptor*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return descriptor;
}

void push_metatable(lua_State* L, const Type& type) {
  luaL_newmetatable(L, type.name.c_str());
  add_object_metamethods(L);
  lua_pushlightuserdata(L, const_cast<Type*>(&type));
  lua_newtable(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -4, "__methods");
  lua_pushcclosure(L, index_object, 2);
  lua_setfield(L, -2, "__index");
  set_closure(L, type, "__newindex", set_object);
  set_closure(L, type, "__tostring", show_object);
}

void add_method_to_metatable(lua_State* L, const char* type, const char* method) {
  luaL_getmetatable(L, type);
  lua_getfield(L, -1, "__methods");
  lua_pushvalue(L, -3);
  lua_setfield(L, -2, method);
  lua_pop(L, 3);
}

}  // namespace dotyk::script

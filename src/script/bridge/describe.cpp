// Descriptions written in Lua, as tables.
#include <stdexcept>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/lua.hpp"

namespace dotyk::script {
namespace {

constexpr std::pair<const char*, Kind> kinds[] = {
    {"number", Kind::number}, {"integer", Kind::integer}, {"boolean", Kind::boolean},
    {"string", Kind::string}, {"file", Kind::file},     {"choice", Kind::choice},   {"vector", Kind::vector},
    {"matrix", Kind::matrix}, {"field", Kind::field},     {"function", Kind::function},
    {"object", Kind::object}, {"list", Kind::list},       {"table", Kind::table},
    {"either", Kind::either}, {"any", Kind::any}};

std::string text_field(lua_State* L, int index, const char* name) {
  const bool given = lua_getfield(L, index, name) == LUA_TSTRING;
  const std::string text = given ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return text;
}

Kind kind_named(const std::string& name) {
  for (const auto& [text, kind] : kinds) {
    if (name == text) return kind;
  }
  throw std::runtime_error("no kind is called '" + name + "'");
}

template <class Read>
void each(lua_State* L, int index, const char* name, Read&& read) {
  if (lua_getfield(L, index, name) == LUA_TTABLE) {
    const int list = lua_gettop(L);
    for (lua_Integer i = 1; lua_rawgeti(L, list, i) != LUA_TNIL; ++i) {
      read(lua_gettop(L));
      lua_settop(L, list);
    }
    lua_settop(L, list);
  }
  lua_pop(L, 1);
}

template <class Set>
void number_field(lua_State* L, int index, const char* name, Set&& set) {
  if (lua_getfield(L, index, name) == LUA_TNUMBER) set(lua_tonumber(L, -1));
  lua_pop(L, 1);
}

void read_default(lua_State* L, int index, Key& key) {
  switch (lua_getfield(L, index, "default")) {
    case LUA_TNUMBER:
      key.fallback(static_cast<double>(lua_tonumber(L, -1)));
      break;
    case LUA_TBOOLEAN:
      key.fallback(static_cast<bool>(lua_toboolean(L, -1)));
      break;
    case LUA_TSTRING:
      key.fallback(lua_tostring(L, -1));
      break;
    default:
      break;
  }
  lua_pop(L, 1);
}

Key read_key(lua_State* L, int index) {
  luaL_checkstack(L, 8, nullptr);
  Key key;
  key.name = text_field(L, index, "name");
  key.kind = kind_named(text_field(L, index, "kind"));
  key.help = text_field(L, index, "help");
  key.units = text_field(L, index, "unit");
  key.type = text_field(L, index, "type");
  read_default(L, index, key);
  key.default_text = key.default_text.empty() ? text_field(L, index, "otherwise") : key.default_text;
  lua_getfield(L, index, "required");
  key.needed = lua_toboolean(L, -1);
  lua_getfield(L, index, "written");
  key.output = lua_toboolean(L, -1);
  lua_pop(L, 2);
  number_field(L, index, "above", [&](double value) { key.above(value); });
  number_field(L, index, "at_least", [&](double value) { key.at_least(value); });
  number_field(L, index, "at_most", [&](double value) { key.greatest = value; });
  number_field(L, index, "fewest", [&](double value) { key.fewest = static_cast<std::size_t>(value); });
  number_field(L, index, "most", [&](double value) { key.most = static_cast<std::size_t>(value); });
  each(L, index, "choices", [&](int at) { key.choices.emplace_back(luaL_checkstring(L, at)); });
  each(L, index, "keys", [&](int at) { key.keys.push_back(read_key(L, at)); });
  if (lua_getfield(L, index, "item") == LUA_TTABLE) key.items = {read_key(L, lua_gettop(L))};
  lua_pop(L, 1);
  return key;
}

}  // namespace

Descriptor read_descriptor(lua_State* L, int index) {
  Descriptor descriptor;
  descriptor.name = text_field(L, index, "name");
  descriptor.help = text_field(L, index, "help");
  descriptor.setup = text_field(L, index, "setup");
  descriptor.example = text_field(L, index, "example");
  descriptor.returns = text_field(L, index, "returns");
  if (descriptor.name.empty()) throw std::runtime_error("a description needs a name");
  each(L, index, "arguments", [&](int at) { descriptor.arguments.push_back(read_key(L, at)); });
  auto table = key::table({});
  each(L, index, "keys", [&](int at) { table.keys.push_back(read_key(L, at)); });
  if (lua_getfield(L, index, "item") == LUA_TTABLE) table.items = {read_key(L, lua_gettop(L))};
  lua_pop(L, 1);
  if (!table.keys.empty() || !table.items.empty()) descriptor.arguments = {table};
  return descriptor;
}

}  // namespace dotyk::script

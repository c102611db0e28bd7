#include "script/bridge/call.hpp"

#include <algorithm>

#include "script/help/nearest.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {

Call::Call(lua_State* L, const Descriptor& descriptor)
    : Arguments(L, descriptor.short_name()), descriptor_(descriptor) {
  check_self();
  const int first = descriptor.owner().empty() ? 1 : 2;
  if (descriptor.takes_table()) open_table(first);
  else open_positional(first);
}

void Call::open_table(int first) {
  lua_State* L = L_;
  if (lua_gettop(L) > first)
    throw ArgumentError("takes one table of keys, got " + std::to_string(lua_gettop(L) - first + 1) + " arguments");
  if (lua_gettop(L) < first) lua_newtable(L);
  if (const auto* key = meant(first)) {
    lua_createtable(L, 0, 1);
    lua_insert(L, first);
    lua_setfield(L, first, key->name.c_str());
  }
  if (lua_type(L, first) != LUA_TTABLE) {
    const auto &keys = descriptor_.arguments[0].keys, &items = descriptor_.arguments[0].items;
    const auto wanted = keys.empty() && !items.empty() ? "a table of " + (items[0].type.empty() ? "items" : plural(items[0].type))
                                                       : "a table of keys (" + join(names_of(keys), "and", "") + ")";
    throw ArgumentError("expected " + wanted + ", got " + describe_value(L, first));
  }
  static_cast<Arguments&>(*this) = Arguments(L, first, descriptor_.arguments[0], callee_);
}

const Key* Call::meant(int first) const {
  const auto& keys = descriptor_.arguments[0].keys;
  if (keys.empty() || keys[0].kind != Kind::file) return nullptr;
  if (lua_type(L_, first) == LUA_TSTRING) return &keys[0];
  const auto is_function = [](const Key& key) { return key.kind == Kind::function; };
  const bool may_be = keys.size() > 1 && keys[1].kind == Kind::either && std::any_of(keys[1].keys.begin(), keys[1].keys.end(), is_function);
  return may_be && lua_type(L_, first) == LUA_TFUNCTION ? &keys[1] : nullptr;
}

void Call::check_self() const {
  const auto owner = descriptor_.owner();
  if (!owner.empty()) {
    const auto* holder = object_at(L_, 1, owner.c_str());
    if (!holder)
      throw ArgumentError("expected " + with_article(owner) + " before it, got " + describe_value(L_, 1) +
                          " (write " + owner + ":" + callee_ + " with a colon, not a dot)");
    if (!holder->pointer) throw ArgumentError("this " + owner + " was released");
  } else if (descriptor_.name.find('.') != std::string::npos && lua_istable(L_, 1) && luaL_getmetafield(L_, 1, "__module") != LUA_TNIL) {
    throw ArgumentError("write " + descriptor_.name + " with a dot, not a colon");
  }
}

void Call::open_positional(int first) {
  const auto& arguments = descriptor_.arguments;
  const int given = lua_gettop(L_) - first + 1;
  keys_ = &arguments;
  luaL_checkstack(L_, static_cast<int>(arguments.size()) + 8, nullptr);
  if (const auto count = arguments.size(); given > static_cast<int>(count))
    throw ArgumentError("takes " + (count == 0 ? "no argument" : counted(count, "argument")) + ", got " + std::to_string(given));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const int index = first + static_cast<int>(i);
    const auto what = "argument " + std::to_string(i + 1) + (arguments[i].name.empty() ? "" : " '" + arguments[i].name + "'");
    if (lua_isnoneornil(L_, index)) {
      if (arguments[i].needed) {
        const bool passed = static_cast<int>(i) < given;
        throw ArgumentError(what + (passed ? " is nil (a variable misspelt or not yet set?)" : " is missing") + ", expected " +
                            arguments[i].expected());
      }
      slots_.push_back(0);
      continue;
    }
    check_value(L_, index, arguments[i], what);
    slots_.push_back(index);
  }
}

int Call::give_all(const std::vector<double>& values) const {
  luaL_checkstack(L_, static_cast<int>(values.size()) + 4, nullptr);
  for (const double value : values) lua_pushnumber(L_, value);
  return static_cast<int>(values.size());
}

Self Call::give_self() const {
  lua_pushvalue(L_, 1);
  return {};
}

void Call::keep(int object_index, const std::string& name, int slot) const {
  object_index = lua_absindex(L_, object_index);
  luaL_checkstack(L_, 4, nullptr);
  if (lua_getiuservalue(L_, object_index, 1) != LUA_TTABLE) {
    lua_pop(L_, 1);
    lua_newtable(L_);
    lua_pushvalue(L_, -1);
    lua_setiuservalue(L_, object_index, 1);
  }
  lua_pushvalue(L_, slot);
  lua_setfield(L_, -2, name.c_str());
  lua_pop(L_, 1);
}

int Arguments::kept(int object_index, const std::string& name) const {
  luaL_checkstack(L_, 4, nullptr);
  const bool found = lua_getiuservalue(L_, object_index, 1) == LUA_TTABLE && lua_getfield(L_, -1, name.c_str()) != LUA_TNIL;
  return found ? lua_gettop(L_) : 0;
}

std::vector<Function> Arguments::kept_function(int object_index, const std::string& name) const {
  const int index = kept(object_index, name);
  if (index == 0) return {};
  return {Function(L_, index, name, callee_)};
}

}  // namespace dotyk::script

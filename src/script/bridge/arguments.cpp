#include "script/bridge/arguments.hpp"

#include <algorithm>

#include "script/help/nearest.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {
namespace {

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.name);
  return names;
}

std::string about(const Key& key) { return key.help + (key.units.empty() ? "" : ", " + key.units); }

// Refuses keys the table may not have; returns the number of items, counting
// the holes a nil leaves.
lua_Integer check_keys(lua_State* L, int index, const Key& table, const std::string& place) {
  lua_Integer items = 0;
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      const std::string name = lua_tostring(L, -2);
      const bool known =
          std::any_of(table.keys.begin(), table.keys.end(), [&](const Key& key) { return key.name == name; });
      if (!known) throw ArgumentError(place + unknown_name("key", name, names_of(table.keys)));
      continue;
    }
    int exact = 0;
    const lua_Integer at = lua_type(L, -2) == LUA_TNUMBER ? lua_tointegerx(L, -2, &exact) : 0;
    if (!exact || at < 1) throw ArgumentError(place + describe_value(L, -2) + " cannot be a key here");
    if (table.items.empty()) {
      throw ArgumentError(place + describe_value(L, -1) + " given without a key, expected " +
                          join(names_of(table.keys)));
    }
    items = std::max(items, at);
  }
  return items;
}

void check_items(lua_State* L, int index, lua_Integer items, const Key& table, const std::string& place) {
  const auto& item = table.items.front();
  for (lua_Integer i = 1; i <= items; ++i) {
    lua_rawgeti(L, index, i);
    check_value(L, -1, item, place + "item " + std::to_string(i));
    lua_pop(L, 1);
  }
  const auto count = static_cast<std::size_t>(items);
  if (count >= table.items.front().fewest && count <= table.items.front().most) return;
  const auto wanted = item.kind == Kind::object ? item.type : item.name;
  const auto number = item.fewest == item.most ? std::to_string(item.fewest)
                      : count < item.fewest    ? "at least " + std::to_string(item.fewest)
                                               : "at most " + std::to_string(item.most);
  throw ArgumentError(place + "takes " + number + " " +
                      (number == "1" || number == "at least 1" || number == "at most 1" ? wanted : plural(wanted)) +
                      ", got " + std::to_string(items) + (items == 0 ? " (or nil)" : ""));
}

}  // namespace

Arguments::Arguments(lua_State* L, int index, const Key& table, std::string callee, const std::string& place)
    : L_(L), callee_(std::move(callee)), table_(lua_absindex(L, index)), keys_(&table.keys) {
  luaL_checkstack(L, static_cast<int>(table.keys.size()) + 8, nullptr);
  const auto items = check_keys(L, table_, table, place);
  if (!table.items.empty()) check_items(L, table_, items, table, place);
  for (const auto& key : table.keys) {
    lua_pushlstring(L, key.name.data(), key.name.size());
    lua_rawget(L, table_);
    if (lua_isnil(L, -1)) {
      if (key.needed)
        throw ArgumentError(place + "missing key '" + key.name + "' (" + about(key) +
                            "), or its value is nil");
      lua_pop(L, 1);
      slots_.push_back(0);
    } else {
      check_value(L, -1, key, place + "'" + key.name + "'");
      slots_.push_back(lua_gettop(L));
    }
  }
}

std::pair<const Key&, int> Arguments::find(const std::string& name) const {
  for (std::size_t i = 0; keys_ && i < keys_->size(); ++i)
    if ((*keys_)[i].name == name) return {(*keys_)[i], slots_[i]};
  throw std::logic_error("the binding asks for '" + name + "', which its descriptor lacks");
}

int Arguments::slot(const std::string& name) const {
  const int at = find(name).second;
  if (at == 0) throw std::logic_error("the binding reads '" + name + "', which is absent and has no fallback");
  return at;
}

bool Arguments::has(const std::string& name) const { return find(name).second != 0; }

bool Arguments::known(const std::string& name) const {
  const auto [key, at] = find(name);
  return key.default_value.index() != 0 || at != 0;
}

bool Arguments::is(const std::string& name, int type) const {
  return has(name) && lua_type(L_, slot(name)) == type;
}

template <class T>
const T* Arguments::fallback_of(const std::string& name) const {
  const auto [key, at] = find(name);
  return at == 0 ? std::get_if<T>(&key.default_value) : nullptr;
}

double Arguments::number(const std::string& name) const {
  if (const auto* fallback = fallback_of<double>(name)) return *fallback;
  return lua_tonumber(L_, slot(name));
}

long long Arguments::integer(const std::string& name) const {
  if (const auto* fallback = fallback_of<double>(name)) return static_cast<long long>(*fallback);
  return lua_tointeger(L_, slot(name));
}

bool Arguments::boolean(const std::string& name) const {
  if (const auto* fallback = fallback_of<bool>(name)) return *fallback;
  return lua_toboolean(L_, slot(name));
}

std::string Arguments::text(const std::string& name) const {
  if (const auto* fallback = fallback_of<std::string>(name)) return *fallback;
  std::size_t length = 0;
  const char* start = lua_tolstring(L_, slot(name), &length);
  return {start, length};
}

std::size_t Arguments::choice(const std::string& name) const { return find(name).first.which(text(name)); }

std::vector<double> read_vector(lua_State* L, int index) {
  return read_list(L, index, [L](int at) { return static_cast<double>(lua_tonumber(L, at)); });
}

std::vector<double> Arguments::vector(const std::string& name) const { return read_vector(L_, slot(name)); }

std::vector<long long> Arguments::integers(const std::string& name) const {
  return read_list(L_, slot(name), [this](int at) { return static_cast<long long>(lua_tointeger(L_, at)); });
}

std::vector<std::string> Arguments::texts(const std::string& name) const {
  return read_list(L_, slot(name), [this](int at) { return std::string(lua_tostring(L_, at)); });
}

std::vector<std::vector<double>> Arguments::matrix(const std::string& name) const {
  return read_list(L_, slot(name), [this](int at) { return read_vector(L_, at); });
}

Function Arguments::function(const std::string& name) const { return {L_, slot(name), name, callee_}; }

Field Arguments::field(const std::string& name, std::size_t components) const {
  if (const auto* fallback = fallback_of<double>(name)) return Field(std::vector<double>(components, *fallback));
  const int at = slot(name);
  if (lua_type(L_, at) == LUA_TFUNCTION) return Field(function(name), components);
  const bool scalar = lua_type(L_, at) == LUA_TNUMBER;
  auto constant = scalar ? std::vector<double>{lua_tonumber(L_, at)} : read_vector(L_, at);
  if (constant.size() != components) {
    const auto wanted =
        components == 1 ? std::string("a number") : "a table of " + std::to_string(components) + " numbers";
    throw ArgumentError("'" + name + "' must be " + wanted + " or a function, got " +
                        (scalar ? "a number" : "a table of " + std::to_string(constant.size())));
  }
  return Field(std::move(constant));
}

Arguments Arguments::table(const std::string& name) const {
  const Key* key = &find(name).first;
  if (key->kind == Kind::either) {
    const auto& kinds = key->keys;
    key = &*std::find_if(kinds.begin(), kinds.end(), [](const Key& one) { return one.kind == Kind::table; });
  }
  return {L_, slot(name), *key, callee_, "'" + name + "': "};
}

std::vector<Arguments> Arguments::tables(const std::string& name) const {
  std::vector<Arguments> found;
  if (!has(name)) return found;
  const auto& item = find(name).first.items.front();
  const auto count = static_cast<lua_Integer>(lua_rawlen(L_, slot(name)));
  luaL_checkstack(L_, static_cast<int>(count) * static_cast<int>(item.keys.size() + 1) + 8, "too many items");
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L_, slot(name), i);
    found.emplace_back(L_, lua_gettop(L_), item, callee_);
  }
  return found;
}

std::size_t Arguments::item_count() const { return lua_rawlen(L_, table_); }

}  // namespace dotyk::script

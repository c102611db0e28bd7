#include "script/bridge/arguments.hpp"

#include <cmath>

#include "base/whole_file.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/position.hpp"
#include "script/help/nearest.hpp"

namespace dotyk::script {
namespace {

// The Lua stack as it was, however the scope is left.
class StackGuard {
 public:
  explicit StackGuard(lua_State* L) : L_(L), top_(lua_gettop(L)) { luaL_checkstack(L, 8, nullptr); }
  ~StackGuard() { lua_settop(L_, top_); }
  StackGuard(const StackGuard&) = delete;
  StackGuard& operator=(const StackGuard&) = delete;

 private:
  lua_State* L_;
  int top_;
};

[[noreturn]] void wrong(lua_State* L, int index, const Key& key, const std::string& what) {
  throw ArgumentError(what + " must be " + key.expected() + ", got " + describe_value(L, index));
}

void check_number(lua_State* L, int index, const Key& key, const std::string& what) {
  if (lua_type(L, index) != LUA_TNUMBER) wrong(L, index, key, what);
  const double value = lua_tonumber(L, index);
  if (std::isnan(value) && key.gaps) return;
  if (std::isnan(value)) throw ArgumentError(what + " must be a finite number, got nan (not a number)");
  if (std::isinf(value) && !key.infinite)
    throw ArgumentError(what + " must be a finite number, got " + number_text(value));
  if (!key.in_range(value)) wrong(L, index, key, what);
  if (key.kind == Kind::integer) {
    int exact = 0;
    lua_tointegerx(L, index, &exact);
    if (!exact) wrong(L, index, key, what);
  }
}

// A name that C would cut short at a zero byte, or of a file that --safe keeps from scripts, is refused.
void check_file(lua_State* L, int index, const Key& key, const std::string& what) {
  if (lua_type(L, index) != LUA_TSTRING) wrong(L, index, key, what);
  const auto name = read_value<std::string>(L, index);
  if (name.find('\0') != std::string::npos) throw ArgumentError(what + " must be the name of a file, it has a zero byte");
  if (const auto& folder = Library::of(L).folder) folder->require(name);
  if (key.output && !name.empty()) place_to_write(name);
}

std::string hint(const std::string& given, const std::vector<std::string>& choices) {
  const auto near = nearest(given, choices);
  return near.empty() ? "" : ", did you mean \"" + near + "\"?";
}

void check_choice(lua_State* L, int index, const Key& key, const std::string& what) {
  if (lua_type(L, index) != LUA_TSTRING) wrong(L, index, key, what);
  const std::string given = lua_tostring(L, index);
  if (key.which(given) < key.choices.size()) return;
  throw ArgumentError(what + " must be " + key.expected() + ", got \"" + given + "\"" + hint(given, key.choices));
}

// A table of entries 1 … n that fit `item`, and nothing else.
void check_entries(lua_State* L, int index, const Key& key, const Key& item, const std::string& what) {
  index = lua_absindex(L, index);
  if (lua_type(L, index) != LUA_TTABLE) wrong(L, index, key, what);
  const StackGuard guard(L);
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    int exact = 0;
    const lua_Integer at = lua_type(L, -2) == LUA_TNUMBER ? lua_tointegerx(L, -2, &exact) : 0;
    if (exact && at > count) throw ArgumentError(what + ": entry " + std::to_string(count + 1) + " is nil");
    if (exact && at >= 1) continue;
    const auto name = lua_type(L, -2) == LUA_TSTRING ? "'" + std::string(lua_tostring(L, -2)) + "'" : describe_value(L, -2);
    throw ArgumentError(what + " must be " + key.expected() + ", got the key " + name);
  }
  if (static_cast<std::size_t>(count) < key.fewest || static_cast<std::size_t>(count) > key.most)
    throw ArgumentError(what + " must be " + key.expected() + ", got a table of " + std::to_string(count));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, index, i);
    check_value(L, -1, item, what + ": entry " + std::to_string(i));
    lua_pop(L, 1);
  }
}

// The first kind the value looks like decides; its own message is the best one.
void check_either(lua_State* L, int index, const Key& key, const std::string& what) {
  const int type = lua_type(L, index);
  std::vector<std::string> choices;
  for (const auto& one : key.keys) {
    const StackGuard guard(L);
    try {
      check_value(L, index, one, what);
      return;
    } catch (const ArgumentError&) {
      const bool tables = one.kind == Kind::vector || one.kind == Kind::matrix || one.kind == Kind::list || one.kind == Kind::table;
      const bool numbers = one.kind == Kind::number || one.kind == Kind::integer;
      if ((type == LUA_TTABLE && tables) || (type == LUA_TNUMBER && numbers)) throw;
      if (one.kind == Kind::choice) choices = one.choices;
    }
  }
  throw ArgumentError(what + " must be " + key.expected() + ", got " + describe_value(L, index) +
                      (type == LUA_TSTRING ? hint(lua_tostring(L, index), choices) : ""));
}

void check_object(lua_State* L, int index, const Key& key, const std::string& what) {
  const auto* holder = object_at(L, index, key.type.c_str());
  if (!holder) {
    const bool missing = lua_isnoneornil(L, index);
    throw ArgumentError(what + ": expected " + with_article(key.type) + ", got " + describe_value(L, index) +
                        (missing ? " (a variable misspelt or not yet set?)" : ""));
  }
  if (!holder->pointer) throw ArgumentError(what + ": this " + key.type + " was released");
}

std::string about(const Key& key) { return key.help + (key.units.empty() ? "" : ", " + key.units); }

// Refuses keys the table may not have; returns the number of items, counting
// the holes a nil leaves.
lua_Integer check_keys(lua_State* L, int index, const Key& table, const std::string& place) {
  const auto known = names_of(table.keys);
  lua_Integer items = 0;
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_type(L, -2) == LUA_TSTRING) {
      const std::string name = lua_tostring(L, -2);
      if (std::find(known.begin(), known.end(), name) == known.end()) throw ArgumentError(place + unknown_name("key", name, known));
      continue;
    }
    int exact = 0;
    const lua_Integer at = lua_type(L, -2) == LUA_TNUMBER ? lua_tointegerx(L, -2, &exact) : 0;
    if (!exact || at < 1) throw ArgumentError(place + describe_value(L, -2) + " cannot be a key here");
    if (table.items.empty())
      throw ArgumentError(place + describe_value(L, -1) + " given without a key, expected " + join(names_of(table.keys)));
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
  if (count >= item.fewest && count <= item.most) return;
  const auto wanted = item.kind == Kind::object ? item.type : item.name;
  const char* bound = item.fewest == item.most ? "" : count < item.fewest ? "at least " : "at most ";
  throw ArgumentError(place + "takes " + bound + counted(count < item.fewest ? item.fewest : item.most, wanted) +
                      ", got " + std::to_string(items) + (items == 0 ? " (or nil)" : ""));
}

}  // namespace

void check_value(lua_State* L, int index, const Key& key, const std::string& what) {
  static const Key number = key::number("", ""), row = key::vector("", ""), number_or_gap = key::number("", "").or_nan(), row_with_gaps = key::vector("", "").or_nan();
  index = lua_absindex(L, index);
  const int type = lua_type(L, index);
  const auto require = [&](int wanted) {
    if (type != wanted) wrong(L, index, key, what);
  };
  switch (key.kind) {
    case Kind::number:
    case Kind::integer:
      return check_number(L, index, key, what);
    case Kind::boolean:
      return require(LUA_TBOOLEAN);
    case Kind::string:
      return require(LUA_TSTRING);
    case Kind::file:
      return check_file(L, index, key, what);
    case Kind::choice:
      return check_choice(L, index, key, what);
    case Kind::field:
      if (type == LUA_TFUNCTION) return;
      if (type == LUA_TNUMBER) return check_number(L, index, key, what);
      return check_entries(L, index, key, number, what);
    case Kind::vector:
      return check_entries(L, index, key, key.gaps ? number_or_gap : number, what);
    case Kind::matrix:
      return check_entries(L, index, key, key.gaps ? row_with_gaps : row, what);
    case Kind::list:
      return check_entries(L, index, key, key.items.front(), what);
    case Kind::function:
      return require(LUA_TFUNCTION);
    case Kind::object:
      return check_object(L, index, key, what);
    case Kind::table: {
      require(LUA_TTABLE);
      const StackGuard guard(L);
      Arguments(L, index, key, "", what + ": ");
      return;
    }
    case Kind::either:
      return check_either(L, index, key, what);
    case Kind::any:
      return;
  }
}

Arguments::Arguments(lua_State* L, int index, const Key& table, std::string callee, const std::string& place)
    : L_(L), callee_(std::move(callee)), table_(lua_absindex(L, index)), keys_(&table.keys) {
  luaL_checkstack(L, static_cast<int>(table.keys.size()) + 8, nullptr);
  const auto items = check_keys(L, table_, table, place);
  if (!table.items.empty()) check_items(L, table_, items, table, place);
  for (const auto& key : table.keys) {
    lua_pushlstring(L, key.name.data(), key.name.size());
    lua_rawget(L, table_);
    if (lua_isnil(L, -1)) {
      if (key.needed) throw ArgumentError(place + "missing key '" + key.name + "' (" + about(key) + "), or its value is nil");
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

Field Arguments::field(const std::string& name, std::size_t components) const {
  if (!has(name)) return Field(std::vector<double>(components, number(name)));
  const int at = slot(name);
  if (lua_type(L_, at) == LUA_TFUNCTION) return Field(function(name), components);
  const bool scalar = lua_type(L_, at) == LUA_TNUMBER;
  auto constant = scalar ? std::vector<double>{number(name)} : vector(name);
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

}  // namespace dotyk::script

// Does a value fit its key?
#include <cmath>

#include "base/whole_file.hpp"
#include "script/bridge/arguments.hpp"
#include "script/bridge/library.hpp"
#include "script/help/nearest.hpp"
#include "script/bridge/position.hpp"

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
  std::size_t length = 0;
  const char* start = lua_tolstring(L, index, &length);
  const std::string name(start, length);
  if (name.find('\0') != std::string::npos) throw ArgumentError(what + " must be the name of a file, it has a zero byte");
  if (const auto& folder = Library::of(L).folder) folder->require(name);
  if (key.output && !name.empty()) place_to_write(name);
}

void check_choice(lua_State* L, int index, const Key& key, const std::string& what) {
  if (lua_type(L, index) != LUA_TSTRING) wrong(L, index, key, what);
  const std::string given = lua_tostring(L, index);
  for (const auto& choice : key.choices) {
    if (choice == given) return;
  }
  const auto near = nearest(given, key.choices);
  throw ArgumentError(what + " must be " + key.expected() + ", got \"" + given + "\"" +
                      (near.empty() ? "" : ", did you mean \"" + near + "\"?"));
}

// Visits entries 1 … n of a table that may hold nothing else.
template <class Visit>
void each_entry(lua_State* L, int index, const Key& key, const std::string& what, Visit&& visit) {
  index = lua_absindex(L, index);
  if (lua_type(L, index) != LUA_TTABLE) wrong(L, index, key, what);
  const StackGuard guard(L);
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    int exact = 0;
    const lua_Integer at = lua_type(L, -2) == LUA_TNUMBER ? lua_tointegerx(L, -2, &exact) : 0;
    if (exact && at > count) throw ArgumentError(what + ": entry " + std::to_string(count + 1) + " is nil");
    if (exact && at >= 1) continue;
    const auto name =
        lua_type(L, -2) == LUA_TSTRING ? "'" + std::string(lua_tostring(L, -2)) + "'" : describe_value(L, -2);
    throw ArgumentError(what + " must be " + key.expected() + ", got the key " + name);
  }
  if (static_cast<std::size_t>(count) < key.fewest || static_cast<std::size_t>(count) > key.most) {
    throw ArgumentError(what + " must be " + key.expected() + ", got a table of " + std::to_string(count));
  }
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, index, i);
    visit(lua_gettop(L), what + ": entry " + std::to_string(i));
    lua_pop(L, 1);
  }
}

void check_vector(lua_State* L, int index, const Key& key, const std::string& what) {
  static const Key number = key::number("", "");
  each_entry(L, index, key, what,
             [&](int entry, const std::string& name) { check_number(L, entry, number, name); });
}

void check_matrix(lua_State* L, int index, const Key& key, const std::string& what) {
  static const Key row = key::vector("", "");
  each_entry(L, index, key, what,
             [&](int entry, const std::string& name) { check_vector(L, entry, row, name); });
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
      const bool tables = one.kind == Kind::vector || one.kind == Kind::matrix || one.kind == Kind::list ||
                          one.kind == Kind::table;
      const bool numbers = one.kind == Kind::number || one.kind == Kind::integer;
      if ((type == LUA_TTABLE && tables) || (type == LUA_TNUMBER && numbers)) throw;
      if (one.kind == Kind::choice) choices = one.choices;
    }
  }
  std::string hint;
  if (type == LUA_TSTRING && !choices.empty()) {
    const auto near = nearest(lua_tostring(L, index), choices);
    if (!near.empty()) hint = ", did you mean \"" + near + "\"?";
  }
  throw ArgumentError(what + " must be " + key.expected() + ", got " + describe_value(L, index) + hint);
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

}  // namespace

void check_value(lua_State* L, int index, const Key& key, const std::string& what) {
  index = lua_absindex(L, index);
  const int type = lua_type(L, index);
  switch (key.kind) {
    case Kind::number:
    case Kind::integer:
      return check_number(L, index, key, what);
    case Kind::boolean:
      return type == LUA_TBOOLEAN ? void() : wrong(L, index, key, what);
    case Kind::string:
      return type == LUA_TSTRING ? void() : wrong(L, index, key, what);
    case Kind::file:
      return check_file(L, index, key, what);
    case Kind::choice:
      return check_choice(L, index, key, what);
    case Kind::vector:
      return check_vector(L, index, key, what);
    case Kind::matrix:
      return check_matrix(L, index, key, what);
    case Kind::field:
      if (type == LUA_TFUNCTION) return;
      if (type == LUA_TNUMBER) return check_number(L, index, key, what);
      return check_vector(L, index, key, what);
    case Kind::function:
      return type == LUA_TFUNCTION ? void() : wrong(L, index, key, what);
    case Kind::object:
      return check_object(L, index, key, what);
    case Kind::list:
      return each_entry(L, index, key, what, [&](int entry, const std::string& name) {
        check_value(L, entry, key.items.front(), name);
      });
    case Kind::table: {
      if (type != LUA_TTABLE) wrong(L, index, key, what);
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

}  // namespace dotyk::script

#include "script/guard/lua_guards.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "script/prompt/interrupt.hpp"
#include "script/bridge/lua.hpp"
#include "script/bridge/position.hpp"
#include "script/guard/matcher.hpp"
#include "script/guard/replaced.hpp"

namespace dotyk::script {
namespace {

Matcher& matcher() {
  static Matcher one;
  return one;
}

// ------------------------------------------------------------ which calls may take long

// Steps of the matching at most: each repetition may end anywhere, and each optional letter be there or not.
double steps(std::string_view text, std::string_view pattern) {
  double repeats = pattern.starts_with('^') ? 0 : 1, optional = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    repeats += c == '*' || c == '+' || c == '-' || (c == 'b' && i > 0 && pattern[i - 1] == '%');
    optional += c == '?';
  }
  return static_cast<double>(pattern.size()) * std::pow(static_cast<double>(text.size()), repeats) * std::exp2(optional);
}

bool may_take_long(lua_State* L) {
  constexpr double most = 1e7;  // some hundredths of a second
  return lua_type(L, 1) == LUA_TSTRING && lua_type(L, 2) == LUA_TSTRING && steps(text_at(L, 1), text_at(L, 2)) > most;
}

bool integer_or_none(lua_State* L, int index) {
  int is = 0;
  lua_tointegerx(L, index, &is);
  return is || lua_isnoneornil(L, index);
}

// ------------------------------------------------------------ the functions

// Where text is looked for as it stands, the C library does it in linear time; Lua does not.
int find_plain(lua_State* L) {
  const std::string_view text = text_at(L, 1), wanted = text_at(L, 2);
  const auto size = static_cast<lua_Integer>(text.size());
  const lua_Integer given = luaL_optinteger(L, 3, 1);
  const lua_Integer from = given > 0 ? given : given == 0 || given < -size ? 1 : size + given + 1;
  const void* found = from > size + 1 ? nullptr : memmem(text.data() + from - 1, text.size() - static_cast<std::size_t>(from - 1), wanted.data(), wanted.size());
  if (!found) {
    lua_pushnil(L);
    return 1;
  }
  const lua_Integer at = static_cast<const char*>(found) - text.data() + 1;
  lua_pushinteger(L, at);
  lua_pushinteger(L, at + static_cast<lua_Integer>(wanted.size()) - 1);
  return 2;
}

int in_own_state(lua_State* L, const char* function, int most) {
  lua_settop(L, most);
  lua_Integer anew = 0;
  const int count = matcher()(L, function, 1, 2, 3, anew);
  matcher().done(text_at(L, 1).size());
  return count;
}

int find(lua_State* L) {
  if (!may_take_long(L) || !integer_or_none(L, 3)) return original(L);
  const bool plain = lua_toboolean(L, 4) || text_at(L, 2).find_first_of("^$*+?.([%-") == std::string_view::npos;
  return plain ? find_plain(L) : in_own_state(L, "find", 3);
}

int match(lua_State* L) { return may_take_long(L) && integer_or_none(L, 3) ? in_own_state(L, "match", 3) : original(L); }

// Matches one after the other, as gmatch and gsub take them: none is empty where the last one ended.
struct Matches {
  lua_Integer from = 1, last = 0;  // where to look on, and the first place after the last match
  lua_Integer held = 0;

  // Pushes the captures, or the whole where the pattern has none; how many, 0 at the end. The match is [begin, end).
  int next(lua_State* L, int text, int pattern, lua_Integer& begin, lua_Integer& end) {
    const auto size = static_cast<lua_Integer>(text_at(L, text).size());
    while (from <= size + 1) {
      const int top = lua_gettop(L);
      lua_pushinteger(L, from);
      const int count = matcher()(L, "find", text, pattern, top + 1, held);
      lua_remove(L, top + 1);
      if (lua_isnil(L, top + 1)) break;
      begin = lua_tointeger(L, top + 1), end = lua_tointeger(L, top + 2) + 1;
      lua_remove(L, top + 1);
      lua_remove(L, top + 1);
      if (end == last) {
        lua_settop(L, top);
        from = begin + 1;
        continue;
      }
      from = last = end;
      if (count > 2) return count - 2;
      const std::string_view whole = text_at(L, text);
      lua_pushlstring(L, whole.data() + begin - 1, static_cast<std::size_t>(end - begin));
      return 1;
    }
    from = std::numeric_limits<lua_Integer>::max();
    matcher().done(static_cast<std::size_t>(size));
    return 0;
  }
};

// Upvalues: text, pattern, Matches.
int next_match(lua_State* L) {
  lua_settop(L, 0);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_Integer begin = 0, end = 0;
  return static_cast<Matches*>(lua_touserdata(L, lua_upvalueindex(3)))->next(L, 1, 2, begin, end);
}

// In gmatch '^' is a letter.
int gmatch(lua_State* L) {
  if (!may_take_long(L) || !integer_or_none(L, 3)) return original(L);
  const auto size = static_cast<lua_Integer>(text_at(L, 1).size());
  const lua_Integer given = luaL_optinteger(L, 3, 1);
  lua_settop(L, 2);
  if (text_at(L, 2).starts_with('^')) {
    lua_pushliteral(L, "%");
    lua_insert(L, 2);
    lua_concat(L, 2);
  }
  auto* matches = new (lua_newuserdatauv(L, sizeof(Matches), 0)) Matches;
  matches->from = given > 0 ? given : given == 0 || given < -size ? 1 : size + given + 1;
  lua_pushcclosure(L, next_match, 3);
  return 1;
}

// What takes the place of a match, from its captures on top: argument 3 is a table or a function.
void replace_match(lua_State* L, int captures, lua_Integer begin, lua_Integer end) {
  if (lua_istable(L, 3)) {
    lua_pushvalue(L, -captures);
    lua_gettable(L, 3);
    lua_insert(L, -captures - 1);
    lua_pop(L, captures);
  } else {
    lua_pushvalue(L, 3);
    lua_insert(L, -captures - 1);
    lua_call(L, captures, 1);
  }
  if (lua_toboolean(L, -1)) {
    if (!lua_isstring(L, -1)) luaL_error(L, "invalid replacement value (a %s)", luaL_typename(L, -1));
    return;
  }
  lua_pop(L, 1);
  lua_pushlstring(L, text_at(L, 1).data() + begin - 1, static_cast<std::size_t>(end - begin));
}

int concatenated(lua_State* L, int pieces) {
  luaL_Buffer buffer;
  luaL_buffinit(L, &buffer);
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, pieces));
  for (lua_Integer k = 1; k <= count; ++k) {
    lua_rawgeti(L, pieces, k);
    luaL_addvalue(&buffer);
  }
  luaL_pushresult(&buffer);
  return 1;
}

int gsub(lua_State* L) {
  if (!may_take_long(L) || !integer_or_none(L, 4)) return original(L);
  if (lua_isstring(L, 3)) return in_own_state(L, "gsub", 4);
  if (!lua_istable(L, 3) && !lua_isfunction(L, 3)) return original(L);
  const bool once = text_at(L, 2).starts_with('^');
  const lua_Integer most = std::min(luaL_optinteger(L, 4, std::numeric_limits<lua_Integer>::max()), once ? lua_Integer{1} : std::numeric_limits<lua_Integer>::max());
  lua_settop(L, 3);
  lua_newtable(L);
  Matches matches;
  lua_Integer count = 0, pieces = 0, copied = 1, begin = 0, end = 0;
  const auto keep = [&](lua_Integer until) {
    lua_pushlstring(L, text_at(L, 1).data() + copied - 1, static_cast<std::size_t>(until - copied));
    lua_rawseti(L, 4, ++pieces);
  };
  for (; count < most; ++count) {
    const int captures = matches.next(L, 1, 2, begin, end);
    if (captures == 0) break;
    replace_match(L, captures, begin, end);
    keep(begin);
    lua_rawseti(L, 4, ++pieces);
    copied = end;
  }
  keep(static_cast<lua_Integer>(text_at(L, 1).size()) + 1);
  concatenated(L, 4);
  lua_pushinteger(L, count);
  return 2;
}

}  // namespace

void guard_patterns(lua_State* L) {
  lua_getglobal(L, "string");
  lua_getfield(L, -1, "find");
  let_abandon(reinterpret_cast<std::uintptr_t>(lua_tocfunction(L, -1)));
  lua_pop(L, 2);
  replace(L, {{"string", "find", find}, {"string", "match", match}, {"string", "gmatch", gmatch}, {"string", "gsub", gsub}});
}

}  // namespace dotyk::script

#include "script/guard/lua_guards.hpp"

#include <algorithm>

#include "script/prompt/interrupt.hpp"
#include "script/bridge/lua.hpp"
#include "script/bridge/position.hpp"
#include "script/guard/replaced.hpp"

namespace dotyk::script {
namespace {

constexpr lua_Integer piece = 1 << 20;  // places moved between two looks at Ctrl-C

int repeat(lua_State* L) {
  const bool nothing = lua_type(L, 1) == LUA_TSTRING && lua_rawlen(L, 1) == 0 && lua_isinteger(L, 2) &&
                       (lua_isnoneornil(L, 3) || (lua_type(L, 3) == LUA_TSTRING && lua_rawlen(L, 3) == 0));
  if (!nothing) return original(L);
  lua_pushliteral(L, "");
  return 1;
}

// to[at …] = from[first … last], in the order in which Lua does it; stack indices of the tables, which may be one.
void move_places(lua_State* L, int from, lua_Integer first, lua_Integer last, int to, lua_Integer at) {
  const bool forwards = at > last || at <= first || (from != to && !lua_compare(L, from, to, LUA_OPEQ));
  for (lua_Integer k = 0; k <= last - first; ++k) {
    const auto i = forwards ? k : last - first - k;
    lua_geti(L, from, first + i);
    lua_seti(L, to, at + i);
    if (k % piece == 0) raise_if_interrupted(L);
  }
}

int move(lua_State* L) {
  int known[3] = {0, 0, 0};
  lua_Integer place[3] = {};
  for (int k = 0; k < 3; ++k) place[k] = lua_tointegerx(L, k + 2, &known[k]);
  const auto [first, last, at] = place;
  const int to = lua_isnoneornil(L, 5) ? 1 : 5;
  const bool usual = std::count(known, known + 3, 0) > 0 || !lua_istable(L, 1) || !lua_istable(L, to) || last < first || (first >= 0 && last - first < piece);
  const bool refused = !usual && (!(first > 0 || last < LUA_MAXINTEGER + first) || at > LUA_MAXINTEGER - (last - first + 1) + 1);
  if (usual || refused) return original(L);
  move_places(L, 1, first, last, to, at);
  lua_pushvalue(L, to);
  return 1;
}

// Does #t, of a metatable, call for more than Lua should do without a look at Ctrl-C?
bool calls_length(lua_State* L) { return lua_istable(L, 1) && luaL_getmetafield(L, 1, "__len") != LUA_TNIL && (lua_pop(L, 1), true); }

int insert(lua_State* L) {
  if (lua_gettop(L) != 3 || !calls_length(L)) return original(L);
  const auto end = static_cast<lua_Integer>(static_cast<lua_Unsigned>(luaL_len(L, 1)) + 1u);
  const auto at = luaL_checkinteger(L, 2);
  luaL_argcheck(L, static_cast<lua_Unsigned>(at) - 1u < static_cast<lua_Unsigned>(end), 2, "position out of bounds");
  if (at < end) move_places(L, 1, at, end - 1, 1, at + 1);
  lua_seti(L, 1, at);
  return 0;
}

int remove(lua_State* L) {
  if (lua_gettop(L) != 2 || !calls_length(L)) return original(L);
  const auto size = luaL_len(L, 1);
  const auto at = luaL_checkinteger(L, 2);
  if (size != at)
    luaL_argcheck(L, static_cast<lua_Unsigned>(at) - 1u <= static_cast<lua_Unsigned>(size), 2, "position out of bounds");
  lua_geti(L, 1, at);
  if (at < size) move_places(L, 1, at + 1, size, 1, at);
  lua_pushnil(L);
  lua_seti(L, 1, std::max(at, size));
  return 1;
}

[[noreturn]] void refuse(lua_State* L, const char* name, const char* why) { raise(L, name, why); }

constexpr char of_lua[] = "expected a function written in Lua, not one of Lua's or dotyk's own";

// What a function written in C++ holds is looked at by nobody again.
int set_upvalue(lua_State* L) {
  if (lua_iscfunction(L, 1)) refuse(L, "debug.setupvalue", of_lua);
  return original(L);
}

// Nor are the arguments of one that runs.
int set_local(lua_State* L) {
  const int first = lua_isthread(L, 1) ? 2 : 1;
  lua_State* thread = first == 2 ? lua_tothread(L, 1) : L;
  const auto level = lua_tointeger(L, first);
  lua_Debug frame;
  if (level < 0 || level > 1000000 || !lua_getstack(thread, static_cast<int>(level), &frame)) return original(L);
  lua_getinfo(thread, "S", &frame);
  if (frame.what[0] == 'C') refuse(L, "debug.setlocal", of_lua);
  return original(L);
}

// The metatable of a userdata says what its bytes are.
int set_metatable_of_value(lua_State* L) {
  if (lua_type(L, 1) == LUA_TUSERDATA) refuse(L, "debug.setmetatable", "an object of dotyk's, or a file, keeps its metatable");
  return original(L);
}

// What a userdata refers to, and by which metatable C++ knows it.
int set_user_value(lua_State* L) {
  if (lua_type(L, 1) == LUA_TUSERDATA) refuse(L, "debug.setuservalue", "an object of dotyk's keeps its value");
  return original(L);
}
int get_registry(lua_State* L) { refuse(L, "debug.getregistry", "the registry is Lua's and dotyk's own"); }

}  // namespace

void guard_lua(lua_State* L) {
  guard_patterns(L);
  replace(L, {{"string", "rep", repeat}, {"table", "move", move}, {"table", "insert", insert}, {"table", "remove", remove}});
  replace(L, {{"debug", "setupvalue", set_upvalue}, {"debug", "setlocal", set_local}, {"debug", "setmetatable", set_metatable_of_value},
              {"debug", "setuservalue", set_user_value}, {"debug", "getregistry", get_registry}});
}

}  // namespace dotyk::script

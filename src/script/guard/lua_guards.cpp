#include "script/guard/lua_guards.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "script/bridge/library.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/push.hpp"
#include "script/guard/safe.hpp"
#include "script/help/nearest.hpp"
#include "script/prompt/interrupt.hpp"

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

// Of debug. What is C++'s, or the interpreter's own, is neither shown nor changed: a wrong value there ends the program.
constexpr char of_lua[] = "expected a function written in Lua, not one of Lua's or dotyk's own";

int get_upvalue(lua_State* L) { return lua_iscfunction(L, 1) ? 0 : original(L); }

int set_upvalue(lua_State* L) {
  if (lua_iscfunction(L, 1)) refuse(L, "debug.setupvalue", of_lua);
  return original(L);
}

// The frame that debug.getlocal and setlocal are asked about, ([thread,] level, …), and its thread; null: none.
lua_State* frame_asked(lua_State* L, lua_Debug& frame) {
  lua_State* thread = lua_isthread(L, 1) ? lua_tothread(L, 1) : L;
  const int level = static_cast<int>(lua_tointeger(L, lua_isthread(L, 1) ? 2 : 1));  // cut off as Lua does it
  if (level < 0 || !lua_getstack(thread, level, &frame)) return nullptr;
  lua_getinfo(thread, "S", &frame);
  return thread;
}

int get_local(lua_State* L) {
  lua_Debug frame;
  const bool hidden = !lua_isfunction(L, lua_isthread(L, 1) ? 2 : 1) && frame_asked(L, frame) && frame.what[0] == 'C';
  return hidden ? (lua_pushnil(L), 1) : original(L);
}

int set_local(lua_State* L) {
  lua_Debug frame;
  lua_State* thread = frame_asked(L, frame);
  if (!thread) return original(L);
  if (frame.what[0] == 'C') refuse(L, "debug.setlocal", of_lua);
  luaL_argcheck(L, lua_checkstack(thread, 1), 1, "stack overflow");
  const char* name = lua_getlocal(thread, &frame, static_cast<int>(lua_tointeger(L, lua_isthread(L, 1) ? 3 : 2)));
  if (name) lua_pop(thread, 1);
  // The state of a loop, or a table that is being filled: Lua relies on what it has put there.
  if (name && name[0] == '(' && std::strcmp(name, "(vararg)") != 0)
    refuse(L, "debug.setlocal", "expected a variable that has a name");
  return original(L);
}

// The metatable of a userdata says what its bytes are. Numbers and pointers share one each.
int set_metatable_of_value(lua_State* L) {
  if (lua_isuserdata(L, 1)) refuse(L, "debug.setmetatable", "an object of dotyk's, or a file, keeps its metatable");
  return original(L);
}

// What a userdata refers to, and by which metatable C++ knows it.
int set_user_value(lua_State* L) {
  if (lua_type(L, 1) == LUA_TUSERDATA) refuse(L, "debug.setuservalue", "an object of dotyk's keeps its value");
  return original(L);
}
int get_registry(lua_State* L) { refuse(L, "debug.getregistry", "the registry is Lua's and dotyk's own"); }

// load and loadfile: the mode, argument 3 or 2, allows text alone. Lua does not look at what a compiled chunk holds.
int load_text(lua_State* L) {
  if (lua_gettop(L) < 3) lua_settop(L, 3);
  lua_pushliteral(L, "t");
  lua_replace(L, 3);
  return original(L);
}
int load_text_file(lua_State* L) {
  if (lua_isstring(L, 1)) require_below(L, 1);
  if (lua_gettop(L) < 2) lua_settop(L, 2);
  lua_pushliteral(L, "t");
  lua_replace(L, 2);
  return original(L);
}

// dofile; Lua's own would take a compiled chunk.
int run_file(lua_State* L) {
  const char* file = luaL_optstring(L, 1, nullptr);
  if (file) require_below(L, 1);
  lua_settop(L, 1);
  if (luaL_loadfilex(L, file, "t") != LUA_OK) return lua_error(L);
  lua_callk(L, 0, LUA_MULTRET, 0, [](lua_State* state, int, lua_KContext) { return lua_gettop(state) - 1; });
  return lua_gettop(L) - 1;
}

// What require does after package.preload: upvalue 1 is the table package.
int find_lua_file(lua_State* L) {
  const char* module = luaL_checkstring(L, 1);
  lua_getfield(L, lua_upvalueindex(1), "path");
  const std::string path = luaL_checkstring(L, -1);
  const std::string name = luaL_gsub(L, module, ".", "/");
  std::string tried;
  for (std::size_t start = 0; start <= path.size();) {
    const auto end = std::min(path.find(';', start), path.size());
    const std::string file = luaL_gsub(L, path.substr(start, end - start).c_str(), "?", name.c_str());
    start = end + 1;
    if (file.empty()) continue;
    try {
      if (const auto& folder = Library::of(L).folder) folder->require(file);
    } catch (const std::runtime_error& error) {
      tried += std::string("\n\t") + error.what();
      continue;
    }
    if (access(file.c_str(), R_OK) != 0) {
      tried += "\n\tno file '" + file + "'";
      continue;
    }
    if (luaL_loadfilex(L, file.c_str(), "t") != LUA_OK) return lua_error(L);
    push(L, file);
    return 2;
  }
  push(L, tried.empty() ? tried : tried.substr(2));
  return 1;
}

void search_text_alone(lua_State* L) {
  lua_getglobal(L, "package");
  lua_getfield(L, -1, "searchers");
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, find_lua_file, 1);
  lua_rawseti(L, -2, 2);
  lua_pop(L, 2);
}

// The names in reach of the running function that are no globals: a typing
// slip is as likely in those.
void add_locals(lua_State* L, std::vector<std::string>& names) {
  lua_Debug frame;
  if (!lua_getstack(L, 1, &frame)) return;
  const auto add = [&](const char* name) {
    lua_pop(L, 1);
    if (name[0] != '\0' && name[0] != '(') names.emplace_back(name);
  };
  for (int i = 1; const char* name = lua_getlocal(L, &frame, i); ++i) add(name);
  lua_getinfo(L, "f", &frame);
  for (int i = 1; const char* name = lua_getupvalue(L, -1, i); ++i) add(name);
  lua_pop(L, 1);
}

constexpr char declared[] = "dotyk.declared";  // in the registry: NAME = true

bool is_declared(lua_State* L, const char* name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, declared);
  lua_getfield(L, -1, name);
  const bool is = lua_toboolean(L, -1);
  lua_pop(L, 2);
  return is;
}

int unknown_global(lua_State* L) {
  return guarded(L, "", [L]() -> int {
    if (lua_type(L, 2) != LUA_TSTRING || std::string(lua_tostring(L, 2)) == "_" || is_declared(L, lua_tostring(L, 2))) {
      lua_pushnil(L);
      return 1;
    }
    const std::string name = lua_tostring(L, 2);
    auto known = string_keys(L, 1);
    add_locals(L, known);
    const auto near = nearest(name, known);
    throw std::runtime_error("unknown variable '" + name + "'" +
                             (near.empty() ? "" : ", did you mean '" + near + "'?"));
  });
}

}  // namespace

void guard_lua(lua_State* L) {
  guard_patterns(L);
  replace(L, {{"string", "rep", repeat}, {"table", "move", move}, {"table", "insert", insert}, {"table", "remove", remove}});
  replace(L, {{"debug", "getupvalue", get_upvalue}, {"debug", "setupvalue", set_upvalue},
              {"debug", "getlocal", get_local}, {"debug", "setlocal", set_local}, {"debug", "setmetatable", set_metatable_of_value},
              {"debug", "setuservalue", set_user_value}, {"debug", "getregistry", get_registry}});
  replace(L, {{"_G", "load", load_text}, {"_G", "loadfile", load_text_file}, {"_G", "dofile", run_file}});
  search_text_alone(L);
}

void make_globals_strict(lua_State* L) {
  lua_pushglobaltable(L);
  lua_newtable(L);
  set_field(L, "__index", unknown_global);
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

void declare_global(lua_State* L, const char* name) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, declared);
  set_field(L, name, true);
  lua_pop(L, 1);
}

}  // namespace dotyk::script

#include "script/guard/safe.hpp"

#include <unistd.h>

#include <stdexcept>

#include "script/bridge/position.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/lua.hpp"
#include "script/guard/replaced.hpp"

namespace dotyk::script {
namespace {

void require_below(lua_State* L, int index) {
  const std::string name = lua_tostring(L, index);
  guarded(L, lua_tostring(L, lua_upvalueindex(2)), [&] {
    Library::of(L).folder->require(name);
    return 0;
  });
}

// A function whose first argument names a file, or two of which do. Without one it takes a default (io.input()).
int with_file(lua_State* L) {
  if (lua_isstring(L, 1)) require_below(L, 1);
  return original(L);
}
int with_two_files(lua_State* L) {
  for (const int index : {1, 2}) {
    luaL_checkstring(L, index);
    require_below(L, index);
  }
  return original(L);
}

// load and loadfile: the mode, argument 3 or 2, allows text alone.
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

// Runs the file's text; Lua's own would take a compiled chunk.
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
      Library::of(L).folder->require(file);
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

// Upvalue 1 is the name of what is refused, upvalue 2 the option that refuses it.
int refuse(lua_State* L) {
  raise(L, lua_tostring(L, lua_upvalueindex(1)), std::string("not for scripts run with ") + lua_tostring(L, lua_upvalueindex(2)));
}

int no_variable(lua_State* L) {
  luaL_checkstring(L, 1);
  lua_pushnil(L);
  return 1;
}

void take_away(lua_State* L, const char* library, const char* name, const char* option = "--safe") {
  lua_getglobal(L, library);
  lua_pushfstring(L, "%s.%s", library, name);
  lua_pushstring(L, option);
  lua_pushcclosure(L, refuse, 2);
  lua_setfield(L, -2, name);
  lua_pop(L, 1);
}

void keep_lua_searchers(lua_State* L) {
  lua_getglobal(L, "package");
  lua_createtable(L, 2, 0);
  lua_getfield(L, -2, "searchers");
  lua_rawgeti(L, -1, 1);  // package.preload
  lua_rawseti(L, -3, 1);
  lua_pop(L, 1);
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, find_lua_file, 1);
  lua_rawseti(L, -2, 2);
  // require keeps the table it was made with as its upvalue, and asks it for "searchers" anew each time.
  lua_setfield(L, -2, "searchers");
  set_field(L, "cpath", "");
  lua_pop(L, 1);
}

}  // namespace

void close_debug(lua_State* L, const char* option) {
  lua_getglobal(L, "debug");
  for (const auto& name : string_keys(L, -1))
    if (name != "traceback") take_away(L, "debug", name.c_str(), option);
  luaL_getmetatable(L, LUA_FILEHANDLE);
  set_field(L, "__metatable", "a file");
  lua_pop(L, 2);
}

void make_safe(lua_State* L, const Folder& folder) {
  Library::of(L).folder = folder;
  replace(L, {{"io", "open", with_file}, {"io", "lines", with_file}, {"io", "input", with_file}, {"io", "output", with_file},
              {"os", "remove", with_file}, {"os", "rename", with_two_files}, {"os", "getenv", no_variable},
              {"_G", "load", load_text}, {"_G", "loadfile", load_text_file}, {"_G", "dofile", run_file}});
  for (const char* name : {"popen", "tmpfile"}) take_away(L, "io", name);
  for (const char* name : {"execute", "tmpname"}) take_away(L, "os", name);
  for (const char* name : {"loadlib", "searchpath"}) take_away(L, "package", name);
  close_debug(L, "--safe");
  keep_lua_searchers(L);
}

}  // namespace dotyk::script

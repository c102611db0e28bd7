#include "script/bridge/lua_side.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/whole_file.hpp"
#include "figure/door/drawing.hpp"
#include "script/bridge/library.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/guard/manifest.hpp"
#include "script/bridge/position.hpp"
#include "script/prompt/terminal.hpp"

namespace dotyk::script {
namespace {

int fail(lua_State* L) {
  const std::string message = luaL_checkstring(L, 1);
  raise(L, "", message);
}

int terminal(lua_State* L) {
  static const char* const names[] = {"stdin", "stdout", "stderr", nullptr};
  lua_pushboolean(L, isatty(luaL_checkoption(L, 1, "stdout", names)));
  return 1;
}

int progress(lua_State* L) {
  return guarded(L, "progress", [L] {
    if (lua_isnoneornil(L, 1)) clear_progress();
    else show_progress(luaL_checkstring(L, 1));
    return 0;
  });
}

int unless_interrupted(lua_State* L) {
  lua_pushvalue(L, 1);
  int status = LUA_OK;
  if (runs_for_prompt(L)) status = lua_pcall(L, 0, 0, 0);
  else lua_call(L, 0, 0);  // errors show the stack of calls they come from (--traceback)
  if (status == LUA_OK) {
    lua_pushboolean(L, true);
    return 1;
  }
  if (!interrupted()) return lua_error(L);
  answer_interrupt();  // or kept() could not run
  lua_pushvalue(L, 2);
  lua_call(L, 0, 1);
  if (lua_type(L, -1) != LUA_TSTRING) {
    lua_pop(L, 1);
    return lua_error(L);
  }
  clear_progress();
  std::fprintf(stderr, "stopped: %s\n", lua_tostring(L, -1));
  lua_pushboolean(L, false);
  return 1;
}

int write(lua_State* L) {
  return guarded(L, "", [L] {
    const std::string file = luaL_checkstring(L, 1);
    if (const auto& folder = Library::of(L).folder) folder->require(file);
    write_whole_file(file, luaL_checkstring(L, 2));
    if (const auto& manifest = Library::of(L).manifest) manifest->write(L, file, "dotyk.work_precision", 0);
    return 0;
  });
}

int check_figure(lua_State* L) {
  return guarded(L, "work_precision", [L] {
    const auto text = [L](int argument) { return std::string(luaL_optstring(L, argument, "")); };
    figure::Sheet sheet;
    sheet.file = text(1);
    if (!lua_isnoneornil(L, 1)) figure::check_sheet(sheet);
    figure::check_text("'title'", text(2));
    figure::check_text("'label'", text(3));
    return 0;
  });
}

int clock(lua_State* L) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  lua_pushnumber(L, std::chrono::duration<double>(now).count());
  return 1;
}

int type_name(lua_State* L) {
  return guarded(L, "type_name", [L] {
    const auto* type = Library::of(L).type_at(L, 1);
    push(L, type ? type->name.c_str() : luaL_typename(L, 1));
    return 1;
  });
}

int signature(lua_State* L) {
  return guarded(L, "signature", [L] {
    const auto* descriptor = descriptor_at(L, 1);
    if (descriptor) push(L, descriptor->signature());
    else lua_pushnil(L);
    return 1;
  });
}

// Of a callable of dotyk's its name, and, where it is written in Lua, file and function.
int written(lua_State* L) {
  return guarded(L, "written", [L] {
    const auto* descriptor = descriptor_at(L, 1);
    if (!descriptor) return 0;
    push(L, descriptor->name);
    if (descriptor->in_lua.file.empty()) return 1;
    push(L, descriptor->in_lua.file);
    push(L, descriptor->in_lua.name);
    return 3;
  });
}

std::string own_text(lua_State* L, const std::string& name) {
  const auto path = std::string(lua_folder()) + "/" + name + ".lua";
  std::ifstream file(path, std::ios::binary);
  if (!file) luaL_error(L, "cannot read %s", path.c_str());
  return {std::istreambuf_iterator<char>(file), {}};
}

int read_own(lua_State* L) {
  push(L, own_text(L, luaL_checkstring(L, 1)));
  return 1;
}

constexpr char own_globals[] = "dotyk.own_globals";  // in the registry: _ENV of dotyk's own files

// The globals as they are, but print, and beyond them those of the moment.
void keep_own_globals(lua_State* L) {
  lua_newtable(L);
  lua_pushglobaltable(L);
  for (lua_pushnil(L); lua_next(L, -2);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);
    lua_rawset(L, -5);
  }
  lua_createtable(L, 0, 1);
  lua_insert(L, -2);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  lua_pushnil(L);
  lua_setfield(L, -2, "print");
  lua_setfield(L, LUA_REGISTRYINDEX, own_globals);
}

// Loads lua/<name>.lua and calls it with the core table, upvalue 1 here.
int load(lua_State* L) {
  const std::string name = luaL_checkstring(L, 1);
  lua_getfield(L, LUA_REGISTRYINDEX, "dotyk.loaded");
  if (lua_getfield(L, -1, name.c_str()) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  const auto text = own_text(L, name);
  const auto chunk = std::string(own_chunk) + " " + name + ".lua";
  if (luaL_loadbufferx(L, text.data(), text.size(), chunk.c_str(), "t") != LUA_OK) return lua_error(L);
  lua_getfield(L, LUA_REGISTRYINDEX, own_globals);
  lua_setupvalue(L, -2, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_call(L, 1, 1);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    lua_pushboolean(L, true);
  }
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, name.c_str());
  return 1;
}

}  // namespace

const char* lua_folder() {
  static const std::string folder = [] {
    if (const char* named = std::getenv("DOTYK_LUA")) return std::string(named);
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto installed = program.parent_path().parent_path() / "share/dotyk/lua";
    if (!error && std::filesystem::exists(installed / "init.lua", error)) return installed.string();
    return std::string(DOTYK_LUA_SOURCE);
  }();
  return folder.c_str();
}

void push_own_function(lua_State* L, const char* file, const char* name) {
  lua_getfield(L, LUA_REGISTRYINDEX, "dotyk.load");
  lua_pushstring(L, file);
  lua_call(L, 1, 1);
  lua_getfield(L, -1, name);
  lua_remove(L, -2);
}

void load_lua_side(lua_State* L) {
  lua_newtable(L);
  lua_setfield(L, LUA_REGISTRYINDEX, "dotyk.loaded");
  keep_own_globals(L);
  lua_newtable(L);
  static const luaL_Reg functions[] = {
      {"fail", fail},         {"terminal", terminal},   {"progress", progress}, {"clock", clock},
      {"write", write}, {"check_figure", check_figure},       {"type_name", type_name}, {"written", written},   {"signature", signature},
      {"read_own", read_own}, {"unless_interrupted", unless_interrupted},       {nullptr, nullptr}};
  luaL_setfuncs(L, functions, 0);
  lua_getglobal(L, "debug");
  lua_getfield(L, -1, "getinfo");
  lua_setfield(L, -3, "getinfo");
  lua_pop(L, 1);
  set_field(L, "folder", lua_folder());
  luaL_getsubtable(L, LUA_REGISTRYINDEX, inputs_of_prompt);
  lua_setfield(L, -2, "inputs");
  lua_pushvalue(L, -1);
  lua_pushcclosure(L, load, 1);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, "load");
  lua_remove(L, -2);
  lua_pushvalue(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, "dotyk.load");
  lua_pushliteral(L, "init");
  if (lua_pcall(L, 1, 0, 0) == LUA_OK) return;
  const std::string reason = luaL_tolstring(L, -1, nullptr);
  lua_settop(L, 0);
  throw std::runtime_error("the Lua files of dotyk, in " + std::string(lua_folder()) +
                           ", cannot be loaded: " + reason);
}

}  // namespace dotyk::script

#include "script/interpreter.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>

#include "script/bind/bind.hpp"
#include "script/prompt/kept_locals.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/lua.hpp"
#include "script/guard/lua_guards.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/push.hpp"
#include "script/guard/strict.hpp"

namespace dotyk::script {
namespace {

// The error value as a text: strings as they are, objects by __tostring; of what is neither, where it was raised.
int to_message(lua_State* L) {
  keep_locals_after_error(L);
  if (!lua_isstring(L, 1) && luaL_getmetafield(L, 1, "__tostring") == LUA_TNIL) {
    push(L, position(L) + "error with " + describe_value(L, 1) + " in place of a message");
    return 1;
  }
  lua_settop(L, 1);
  luaL_tolstring(L, 1, nullptr);
  return 1;
}

int to_traced_message(lua_State* L) {
  to_message(L);
  luaL_traceback(L, L, lua_tostring(L, -1), 1);
  return 1;
}

void fill(lua_State* L, Library& library) {
  luaL_openlibs(L);
  guard_lua(L);
  bind_all(library);
  lua_getglobal(L, "dotyk");
  set_field(L, "version", DOTYK_VERSION);
  lua_pop(L, 1);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_getglobal(L, "dotyk");
  lua_setfield(L, -2, "dotyk");
  lua_pop(L, 1);
  load_lua_side(L);
  make_globals_strict(L);
}

}  // namespace

Interpreter::Interpreter() : L_(luaL_newstate()) {
  if (!L_) throw std::bad_alloc();
  try {
    library_ = std::make_unique<Library>(L_);
    fill(L_, *library_);
  } catch (const std::exception&) {
    lua_close(L_);
    throw;
  }
}

Interpreter::~Interpreter() { lua_close(L_); }

void Interpreter::set_arguments(const std::string& script, const std::vector<std::string>& arguments) {
  lua_createtable(L_, static_cast<int>(arguments.size()), 1);
  push(L_, script);
  lua_rawseti(L_, -2, 0);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    push(L_, arguments[i]);
    lua_rawseti(L_, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setglobal(L_, "arg");
}

std::optional<std::string> Interpreter::call(int count, int results) {
  const int base = lua_gettop(L_) - count;
  lua_pushcfunction(L_, trace_ ? to_traced_message : to_message);
  lua_insert(L_, base);
  const int status = lua_pcall(L_, count, results, base);
  lua_remove(L_, base);
  if (status == LUA_OK) return std::nullopt;
  std::string message = lua_type(L_, -1) == LUA_TSTRING ? lua_tostring(L_, -1) : "error without a message";
  lua_pop(L_, 1);
  return message;
}

std::optional<std::string> Interpreter::run_loaded(int load_status) {
  if (load_status != LUA_OK) {
    std::string message = lua_tostring(L_, -1);
    lua_pop(L_, 1);
    return message;
  }
  return call(0, 0);
}

std::string script_in(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with('#')) text.erase(0, std::min(text.find('\n'), text.size()));
  return text;
}

std::optional<std::string> Interpreter::run_file(const std::string& path) {
  const int status = luaL_loadfilex(L_, path == "-" ? nullptr : path.c_str(), "t");
  if (status == LUA_OK && keep_locals_ && path != "-") {
    std::ifstream file(path, std::ios::binary);
    script::keep_locals(L_, script_in({std::istreambuf_iterator<char>(file), {}}), "@" + path);
  }
  return run_loaded(status);
}

std::optional<std::string> Interpreter::run_text(const std::string& text, const std::string& chunk) {
  const int status = luaL_loadbufferx(L_, text.data(), text.size(), ("=" + chunk).c_str(), "t");
  if (status == LUA_OK && keep_locals_) script::keep_locals(L_, text, "=" + chunk);
  return run_loaded(status);
}

}  // namespace dotyk::script

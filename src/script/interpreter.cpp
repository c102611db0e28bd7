#include "script/interpreter.hpp"

#include <new>

#include "script/bind/bind.hpp"
#include "script/prompt/kept_locals.hpp"
#include "script/guard/lua_guards.hpp"
#include "script/bridge/lua_side.hpp"
#include "script/bridge/position.hpp"
#include "script/bridge/push.hpp"

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
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_getglobal(L, "dotyk");
  set_field(L, "version", DOTYK_VERSION);
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
  push(L_, arguments);
  push(L_, script);
  lua_rawseti(L_, -2, 0);
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

std::optional<std::string> Interpreter::run_text(const std::string& text, const std::string& chunk) {
  const std::string name = chunk.starts_with('@') ? chunk : "=" + chunk;
  if (luaL_loadbufferx(L_, text.data(), text.size(), name.c_str(), "t") != LUA_OK) {
    std::string message = lua_tostring(L_, -1);
    lua_pop(L_, 1);
    return message;
  }
  if (keep_locals_) script::keep_locals(L_, text, name);
  return call(0, 0);
}

}  // namespace dotyk::script

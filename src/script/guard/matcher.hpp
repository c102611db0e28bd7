#pragma once
// Patterns matched in a Lua state of its own, which can be given up when Ctrl-C ends a match that would take for ever.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <utility>

#include "script/bridge/lua.hpp"
#include "script/prompt/interrupt.hpp"

namespace dotyk::script {

// The string there, in place.
inline std::string_view text_at(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

// Memory in a list, so that all of it can be given back without asking Lua.
struct Chunk {
  Chunk *before, *after;
};

struct Matching {
  lua_State* from;             // whose strings are at `subject` and `pattern`, and further arguments from `more` to the top
  const char* function;
  int subject, pattern, more;
  bool copied;                 // the state has them already
};

class Matcher {
 public:
  Matcher() = default;
  ~Matcher() { drop(); }
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  // Pushes what string.FUNCTION gives, and returns how many values that is. Errors are raised as the function's. `held`: the
  // number that the strings were given by the last call with them, 0 at first; so that they are not copied again.
  int operator()(lua_State* L, const char* function, int subject, int pattern, int more, lua_Integer& held) {
    if (!state_) state_ = lua_newstate(allocate, this);
    if (!state_) return luaL_error(L, "not enough memory");
    lua_settop(state_, 0);
    Matching call{L, function, subject, pattern, more, held != 0 && held == held_};
    if (!call.copied) held_ = 0;
    lua_pushcfunction(state_, serve);
    lua_pushlightuserdata(state_, &call);
    Run run{state_, LUA_OK};
    if (!abandonable([](void* data) { static_cast<Run*>(data)->now(); }, &run)) {
      drop();
      raise(L, "", "interrupted");
    }
    if (run.status != LUA_OK) {
      lua_pushstring(L, lua_tostring(state_, -1));
      return luaL_error(L, "%s", lua_tostring(L, -1));
    }
    if (!call.copied) held_ = ++last_;
    held = held_;
    return give(L);
  }

  // No copy of a long text is kept for longer than it is of use.
  void done(std::size_t size) {
    if (size > 1 << 20) drop();
  }

 private:
  struct Run {
    lua_State* state;
    int status;
    void now() { status = lua_pcall(state, 1, LUA_MULTRET, 0); }
  };

  static int serve(lua_State* own) {
    const Matching& call = *static_cast<const Matching*>(lua_touserdata(own, 1));
    if (lua_getfield(own, LUA_REGISTRYINDEX, "string") == LUA_TNIL) {
      luaL_requiref(own, "string", luaopen_string, 0);
      lua_setfield(own, LUA_REGISTRYINDEX, "string");
    }
    if (!call.copied)
      for (const auto& [name, index] : {std::pair{"subject", call.subject}, {"pattern", call.pattern}}) {
        const std::string_view text = text_at(call.from, index);
        lua_pushlstring(own, text.data(), text.size());
        lua_setfield(own, LUA_REGISTRYINDEX, name);
      }
    lua_settop(own, 0);
    lua_getfield(own, LUA_REGISTRYINDEX, "string");
    lua_getfield(own, 1, call.function);
    lua_getfield(own, LUA_REGISTRYINDEX, "subject");
    lua_getfield(own, LUA_REGISTRYINDEX, "pattern");
    for (int k = call.more; k <= lua_gettop(call.from); ++k) copy(call.from, k, own);
    lua_call(own, lua_gettop(own) - 2, LUA_MULTRET);
    return lua_gettop(own) - 1;
  }

  static void copy(lua_State* from, int index, lua_State* to) {
    switch (lua_type(from, index)) {
      case LUA_TSTRING: {
        const std::string_view text = text_at(from, index);
        lua_pushlstring(to, text.data(), text.size());
        break;
      }
      case LUA_TNUMBER:
        if (lua_isinteger(from, index)) lua_pushinteger(to, lua_tointeger(from, index));
        else lua_pushnumber(to, lua_tonumber(from, index));
        break;
      default: lua_pushnil(to);
    }
  }

  int give(lua_State* L) {
    const int count = lua_gettop(state_);
    luaL_checkstack(L, count, "too many captures");
    for (int k = 1; k <= count; ++k) copy(state_, k, L);
    return count;
  }

  static void* allocate(void* data, void* block, std::size_t, std::size_t size) {
    auto& own = *static_cast<Matcher*>(data);
    Chunk* old = block ? static_cast<Chunk*>(block) - 1 : nullptr;
    if (size == 0) {
      if (old) own.unlink(old), std::free(old);
      return nullptr;
    }
    Chunk* chunk = static_cast<Chunk*>(old ? std::realloc(old, sizeof(Chunk) + size) : std::malloc(sizeof(Chunk) + size));
    if (!chunk) return nullptr;
    if (!old) chunk->before = nullptr, chunk->after = own.first_;
    (chunk->before ? chunk->before->after : own.first_) = chunk;
    if (chunk->after) chunk->after->before = chunk;
    return chunk + 1;
  }

  void unlink(Chunk* chunk) {
    (chunk->before ? chunk->before->after : first_) = chunk->after;
    if (chunk->after) chunk->after->before = chunk->before;
  }

  void drop() {
    while (first_) {
      Chunk* after = first_->after;
      std::free(first_);
      first_ = after;
    }
    state_ = nullptr;
    held_ = 0;
  }

  lua_State* state_ = nullptr;
  Chunk* first_ = nullptr;
  lua_Integer held_ = 0, last_ = 0;
};

}  // namespace dotyk::script

#include "script/bridge/position.hpp"

#include <cstring>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {

namespace {

bool own(const lua_Debug& frame) { return std::strncmp(frame.source, own_chunk, sizeof own_chunk - 1) == 0; }

}  // namespace

std::string position(lua_State* L, const std::string& callee) {
  const std::string prefix = callee.empty() ? "" : callee + ": ";
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline <= 0 || own(frame)) continue;
    return std::string(frame.short_src) + ":" + std::to_string(frame.currentline) + ": " + prefix;
  }
  return prefix;
}

bool runs_for_prompt(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "S", &frame);
    if (std::strcmp(frame.what, "main") == 0 && !own(frame)) return frame.short_src == std::string(prompt_chunk);
  }
  return position(L).starts_with(std::string(prompt_chunk) + ":");  // a coroutine begins with a function
}

bool called_by_own(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "S", &frame);
    if (frame.what[0] != 'C') return own(frame);
  }
  return false;
}

std::string describe_value(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNONE:
    case LUA_TNIL:
      return "nil";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
      return "the number " + number_text(lua_tonumber(L, index));
    case LUA_TSTRING: {
      const std::string text = lua_tostring(L, index);
      return "the string \"" + (text.size() > 32 ? text.substr(0, 29) + "…" : text) + "\"";
    }
    default:
      break;
  }
  const auto name = meta_text(L, index, "__name");
  return with_article(name.empty() ? luaL_typename(L, index) : name);
}

void raise(lua_State* L, const std::string& callee, const std::string& message) {
  lua_pushstring(L, (position(L, callee) + message).c_str());
  lua_error(L);
  __builtin_unreachable();
}

}  // namespace dotyk::script

#include "script/bridge/object.hpp"

#include <new>
#include <stdexcept>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {
namespace {

// The metatable was checked by whoever calls these only in the usual case: a
// script may reach them by getmetatable, so they check for themselves that the
// value is a userdata with a metatable that has this very function.
Holder* holder_of(lua_State* L, int index, const char* event, lua_CFunction self) {
  if (lua_type(L, index) != LUA_TUSERDATA || luaL_getmetafield(L, index, event) == LUA_TNIL) return nullptr;
  const bool ours = lua_tocfunction(L, -1) == self;
  lua_pop(L, 1);
  return ours ? static_cast<Holder*>(lua_touserdata(L, index)) : nullptr;
}

int release(lua_State* L) {
  if (auto* holder = holder_of(L, 1, "__gc", release)) holder->pointer.reset();
  return 0;
}

int equal(lua_State* L) {
  const auto* a = holder_of(L, 1, "__eq", equal);
  const auto* b = holder_of(L, 2, "__eq", equal);
  lua_pushboolean(L, a && b && a->pointer == b->pointer);
  return 1;
}

}  // namespace

void push_object(lua_State* L, std::shared_ptr<void> pointer, const char* type) {
  luaL_checkstack(L, 4, nullptr);
  auto* place = lua_newuserdatauv(L, sizeof(Holder), 1);
  new (place) Holder{std::move(pointer)};
  if (luaL_getmetatable(L, type) == LUA_TNIL) {
    static_cast<Holder*>(place)->~Holder();
    throw std::logic_error(std::string("type '") + type + "' was never registered");
  }
  lua_setmetatable(L, -2);
}

Holder* object_at(lua_State* L, int index, const char* type) {
  return static_cast<Holder*>(luaL_testudata(L, index, type));
}

std::shared_ptr<void> checked_object(lua_State* L, int index, const char* type) {
  const auto* holder = object_at(L, index, type);
  if (!holder) {
    throw std::runtime_error("expected " + with_article(type) + ", got " + describe_value(L, index));
  }
  if (!holder->pointer) throw std::runtime_error(std::string("this ") + type + " was released");
  return holder->pointer;
}

void add_object_metamethods(lua_State* L) {
  set_field(L, "__gc", release);
  set_field(L, "__close", release);
  set_field(L, "__eq", equal);
  set_field(L, "__metatable", "an object of dotyk");
}

}  // namespace dotyk::script

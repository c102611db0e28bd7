#pragma once
// C++ objects owned by Lua values: a shared pointer in a userdata.
#include <memory>
#include <string>
#include <type_traits>

#include "script/bridge/push.hpp"

namespace dotyk::script {

// What the userdata holds. Empty after release.
struct Holder {
  std::shared_ptr<void> pointer;
};

// A new userdata of the named type; its one user value is a table for the Lua
// values that must live as long (see Call::keep). Leaves it on the stack.
void push_object(lua_State* L, std::shared_ptr<void> pointer, const char* type);

// The holder at index if the value there is an object of that type, else null.
Holder* object_at(lua_State* L, int index, const char* type);

template <class T>
requires requires { Wrapped<std::remove_const_t<T>>::name; }
void push(lua_State* L, const std::shared_ptr<T>& pointer) {
  using Plain = std::remove_const_t<T>;
  push_object(L, std::const_pointer_cast<Plain>(pointer), Wrapped<Plain>::name);
}

// The object at index. Throws std::runtime_error when the value is of another
// type or was released.
std::shared_ptr<void> checked_object(lua_State* L, int index, const char* type);

template <class T>
std::shared_ptr<T> object(lua_State* L, int index) {
  return std::static_pointer_cast<T>(checked_object(L, index, Wrapped<std::remove_const_t<T>>::name));
}

// Adds the metamethods every object has (__gc, __close, __eq) to the metatable
// on top of the stack.
void add_object_metamethods(lua_State* L);

}  // namespace dotyk::script

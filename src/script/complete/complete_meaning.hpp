#pragma once
// What do names that stand before the cursor mean? Found by reading values; no
// script code is run.
#include <string>
#include <vector>

#include "script/complete/complete_context.hpp"

struct lua_State;

namespace dotyk::script {

class Library;
struct Descriptor;
struct Key;
struct Type;

// What a chain stands for: a value on top of the Lua stack, or, behind a call,
// only the class that the call returns.
struct Meaning {
  bool value = false;
  const Type* type = nullptr;
  const Descriptor* callable = nullptr;
  int self = 0;  // stack index of the object whose method the callable is; 0: not known
};

// Leaves values on the stack.
Meaning resolve(lua_State* L, const Library& library, const Chain& chain);

// What the value at the cursor may be, as described by the callable it is given
// to, and the object that the callable is a method of.
struct Place {
  const Key* key = nullptr;
  const Meaning callee = {};
};
// Of the table that the cursor stands in.
Place table_around(lua_State* L, const Library& library, const Context& context);
// Of the value: of a key, an item, an argument, or the string in f "…".
Place value_at(lua_State* L, const Library& library, const Context& context);

}  // namespace dotyk::script

#pragma once
// The C functions Lua sees: one entry for all callables, one set of metamethods
// for all objects.
struct lua_State;

namespace dotyk::script {

struct Descriptor;
struct Type;

// Pushes the callable.
void push_function(lua_State* L, const Descriptor& descriptor);

// The descriptor behind the function at index, or null.
const Descriptor* descriptor_at(lua_State* L, int index);

// Makes and pushes the metatable of a class.
void push_metatable(lua_State* L, const Type& type);

// Takes the function on top of the stack and makes it a method of the class.
void add_method_to_metatable(lua_State* L, const char* type, const char* method);

}  // namespace dotyk::script

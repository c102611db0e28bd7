#pragma once
// C++ values to Lua, and C++ objects owned by Lua values: a shared pointer in a userdata.
#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "script/bridge/lua.hpp"

namespace dotyk::script {

// A word as an argument of a template.
template <std::size_t size>
struct Word {
  char letters[size];
  constexpr Word(const char (&word)[size]) { std::copy_n(word, size, letters); }
};
template <Word word>
struct Called {
  static constexpr const char* name = word.letters;
};

// The word a class goes by in scripts, messages and help. Specialise it beside the binding:
//   template <> struct Wrapped<mesh::Mesh> : Called<"mesh"> {};
template <class T>
struct Wrapped;

// What the userdata holds. Empty after release.
struct Holder {
  std::shared_ptr<void> pointer;
};

// Pushes a new userdata of the named type; its one user value is a table for the Lua values that must live as long (see Call::keep).
void push_object(lua_State* L, std::shared_ptr<void> pointer, const char* type);

// The holder at index if the value there is an object of that type, else null.
Holder* object_at(lua_State* L, int index, const char* type);

// The object at index. Throws std::runtime_error when the value is of another type or was released.
std::shared_ptr<void> checked_object(lua_State* L, int index, const char* type);
template <class T>
std::shared_ptr<T> object(lua_State* L, int index) {
  return std::static_pointer_cast<T>(checked_object(L, index, Wrapped<std::remove_const_t<T>>::name));
}

// Adds the metamethods every object has (__gc, __close, __eq) to the metatable of that type, on top of the stack.
void add_object_metamethods(lua_State* L, const std::string& type);

struct Record;

inline void push(lua_State* L, std::monostate) { lua_pushnil(L); }
inline void push(lua_State* L, bool value) { lua_pushboolean(L, value); }
template <std::integral T>
void push(lua_State* L, T value) {
  lua_pushinteger(L, static_cast<lua_Integer>(value));
}
inline void push(lua_State* L, double value) { lua_pushnumber(L, value); }
inline void push(lua_State* L, const char* value) { lua_pushstring(L, value); }
inline void push(lua_State* L, const std::string& value) { lua_pushlstring(L, value.data(), value.size()); }
inline void push(lua_State* L, lua_CFunction function) { lua_pushcfunction(L, function); }
void push(lua_State* L, const Record& record);

template <class T>
requires requires { Wrapped<std::remove_const_t<T>>::name; }
void push(lua_State* L, const std::shared_ptr<T>& pointer) {
  using Plain = std::remove_const_t<T>;
  push_object(L, std::const_pointer_cast<Plain>(pointer), Wrapped<Plain>::name);
}

// A list.
template <class T>
void push(lua_State* L, const std::vector<T>& values) {
  lua_createtable(L, static_cast<int>(values.size()), 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    push(L, values[i]);
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
}

// A value or nil.
template <class T>
void push(lua_State* L, const std::optional<T>& value) {
  if (value) push(L, *value);
  else lua_pushnil(L);
}

// A name with anything push() knows. Of an empty optional the field is nil, and no error.
struct Entry {
  template <class T>
  Entry(std::string called, const T& given) : name(std::move(called)), push_value([given](lua_State* L) { push(L, given); }) {
    if constexpr (requires { given.has_value(); }) absent = !given;
  }
  Entry(std::string called, const char* text) : Entry(std::move(called), std::string(text)) {}
  std::string name;
  std::function<void(lua_State*)> push_value;
  bool absent = false;
};

// A small table of named values. A record with a name answers an unknown field
// with an error and the nearest name; one without is a plain table.
struct Record {
  std::string name;
  std::vector<Entry> entries;
  Record& add(const std::vector<Entry>& more);  // gives the record again
};

// As field `name` of the table on top of the stack.
template <class T>
void set_field(lua_State* L, const char* name, const T& value) {
  push(L, value);
  lua_setfield(L, -2, name);
}

// Makes the table on top of the stack answer an unknown field with an error
// that names the nearest one, and print what it holds; `name` says what the table is.
void make_strict(lua_State* L, const std::string& name);

// The text of a metafield of the value at index, empty where it has none.
std::string meta_text(lua_State* L, int index, const char* field);

// The string keys of the table at index, sorted; none of another value.
std::vector<std::string> string_keys(lua_State* L, int index);

}  // namespace dotyk::script

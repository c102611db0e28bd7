#pragma once
// C++ values to Lua.
#include <algorithm>
#include <concepts>
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

// The word a class goes by in scripts, messages and help. Specialise it beside
// the binding:
//   template <> struct Wrapped<mesh::Mesh> : Called<"mesh"> {};
template <class T>
struct Wrapped;

struct Entry;

// A small table of named values. A record with a name answers an unknown field
// with an error and the nearest name; one without is a plain table.
struct Record {
  std::string name;
  std::vector<Entry> entries;
  Record& add(const std::vector<Entry>& more);  // gives the record again
};

// Empty: a field that records of the kind have, but this one does not; nil, and no error.
using Value =
    std::variant<std::monostate, double, long long, bool, std::string, std::vector<double>, Record, std::vector<Record>>;

struct Entry {
  template <class T>
  Entry(std::string called, const T& given) : name(std::move(called)) {
    if constexpr (std::is_same_v<T, bool> || !std::is_integral_v<T>) value = given;
    else value = static_cast<long long>(given);
  }
  Entry(std::string called, const char* text) : name(std::move(called)), value(std::string(text)) {}
  template <class T>
  Entry(std::string called, const std::optional<T>& given) : name(std::move(called)) {
    if (given) value = *given;
  }
  std::string name;
  Value value;
};

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

// An object; see object.hpp.
template <class T>
requires requires { Wrapped<std::remove_const_t<T>>::name; }
void push(lua_State* L, const std::shared_ptr<T>& pointer);

// A value or nil.
template <class T>
void push(lua_State* L, const std::optional<T>& value) {
  if (value) push(L, *value);
  else lua_pushnil(L);
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

// As field `name` of the table on top of the stack.
template <class T>
void set_field(lua_State* L, const char* name, const T& value) {
  push(L, value);
  lua_setfield(L, -2, name);
}

// Makes the table on top of the stack answer an unknown field with an error
// that names the nearest one, and print what it holds; `name` says what the table is.
void make_strict(lua_State* L, const std::string& name);

// The string keys of the table at index, sorted.
std::vector<std::string> string_keys(lua_State* L, int index);

}  // namespace dotyk::script

#pragma once
// One running call from Lua: its arguments, checked, and its results.
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "script/bridge/arguments.hpp"

namespace dotyk::script {

// What a binding's run function gets. Named values are read with the accessors
// of Arguments, whether they came by position or as keys of a table.
class Call : public Arguments {
 public:
  // Checks the values on the Lua stack against the descriptor. Throws ArgumentError.
  Call(lua_State* L, const Descriptor& descriptor);

  // The object before the colon.
  template <class T>
  std::shared_ptr<T> self() const {
    return script::object<T>(L_, 1);
  }

  // Pushes the results and returns their number: `return call.give(value);`.
  template <class... Values>
  int give(const Values&... values) const {
    luaL_checkstack(L_, static_cast<int>(sizeof...(values)) + 4, nullptr);
    (push(L_, values), ...);
    return static_cast<int>(sizeof...(values));
  }
  // The components of a vector as separate results.
  int give_all(const std::vector<double>& values) const;
  // The object before the colon again, for calls that can be chained.
  Self give_self() const;

  // Lua values that must live as long as an object (a callback of a solver): gives the object, and keeps with it those of
  // the named arguments that are functions.
  template <class T>
  Given<T> give_keeping(const std::shared_ptr<T>& object, std::initializer_list<const char*> names) const {
    push(L_, object);
    const int index = lua_gettop(L_);
    for (const char* name : names)
      if (is(name, LUA_TFUNCTION)) keep(index, name, slot(name));
    return {};
  }
  void keep(int object_index, const std::string& name, int slot) const;  // the value at a stack index, as name

 private:
  void check_self() const;
  void open_table(int first);
  // What a value given in place of the table stands for: a string for a file, where that comes first (dotyk.qp "name.qps"),
  // a function for what else it may be, where that comes next (dotyk.mesh.gmsh(f)); null: nothing.
  const Key* meant(int first) const;
  void open_positional(int first);

  const Descriptor& descriptor_;
};

template <class Function>
requires std::is_invocable_v<Function, Call&>
Runner::Runner(Function function) {
  using Result = std::invoke_result_t<Function, Call&>;
  if constexpr (std::is_same_v<Result, Self>) returns_ = ":";
  if constexpr (requires { Wrapped<std::remove_const_t<typename Result::element_type>>::name; })
    returns_ = Wrapped<std::remove_const_t<typename Result::element_type>>::name;
  run_ = [function = std::move(function)](Call& call) -> int {
    if constexpr (std::is_same_v<Result, int>) return function(call);
    else if constexpr (std::is_base_of_v<OneResult, Result>) return function(call), 1;
    else if constexpr (std::is_void_v<Result>) return function(call), 0;
    else return call.give(function(call));
  };
}

}  // namespace dotyk::script

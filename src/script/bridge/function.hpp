#pragma once
// Functions of a script, called from C++ while the call that was given them is
// still running. They never outlive it: the numerical rooms hold no Lua values.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "script/bridge/lua.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {

// A Lua function on the stack. Every error says which callable asked: the
// user's own errors keep their line and get "(in 'force' of body)" appended; a
// result that cannot be used throws std::runtime_error naming the point.
class Function {
 public:
  // `slot` is an absolute stack index that stays valid; `key` and `callee` name
  // the function in messages.
  Function(lua_State* L, int slot, std::string key, std::string callee);

  // f(arguments...) -> exactly values.size() numbers, finite but where `infinite` ones are allowed.
  void numbers(std::span<const double> arguments, std::span<double> values, bool infinite = false) const;
  std::vector<double> numbers(std::span<const double> arguments, std::size_t count) const;
  double number(std::span<const double> arguments) const { return numbers(arguments, 1)[0]; }

  // f(arguments...) -> one of dotyk's own objects.
  template <class T>
  std::shared_ptr<T> object(std::span<const double> arguments) const {
    return std::static_pointer_cast<T>(object(arguments, Wrapped<T>::name));
  }

  // f() -> a string.
  std::string text() const;

  // f(arguments...) -> anything, read as Lua's truth.
  bool truth(std::span<const double> arguments) const;

  // f(values...) with anything push() knows -> anything, read as truth; no
  // result at all counts as true. For callbacks: "return false" stops.
  template <class... Arguments>
  bool operator()(const Arguments&... arguments) const {
    begin(static_cast<int>(sizeof...(arguments)));
    (push(L_, arguments), ...);
    return finish(static_cast<int>(sizeof...(arguments)));
  }

  // f(value) with anything push() knows -> one result, left on the stack.
  template <class Argument>
  void result(const Argument& argument) const {
    begin(1);
    push(L_, argument);
    call(1, 1);
  }

 private:
  void begin(int count) const;
  bool finish(int count) const;
  void call(int count, int results) const;
  void call(std::span<const double> arguments, int results) const;
  std::shared_ptr<void> object(std::span<const double> arguments, const char* type) const;

  lua_State* L_;
  int slot_;
  std::string key_, callee_;
};

// A value in space: constant, or a function of the coordinates.
class Field {
 public:
  explicit Field(std::vector<double> constant);
  Field(Function function, std::size_t components);

  bool constant() const { return functions_.empty(); }
  std::size_t components() const { return components_; }

  // The components at a point, written to `values` (components() of them).
  void at(std::span<const double> point, std::span<double> values) const;
  std::vector<double> operator()(std::span<const double> point) const;

 private:
  std::size_t components_;
  std::vector<double> constant_;
  std::vector<Function> functions_;  // none or one
};

}  // namespace dotyk::script

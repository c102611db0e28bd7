#include "script/bridge/function.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "script/bridge/arguments.hpp"
#include "script/prompt/interrupt.hpp"
#include "script/bridge/position.hpp"

namespace dotyk::script {
namespace {

std::string point_text(std::span<const double> point) {
  std::string text;
  for (const double x : point) text += (text.empty() ? "" : ", ") + dotyk::text(x);  // six digits: a place, not a value
  return "(" + text + ")";
}

}  // namespace

Function::Function(lua_State* L, int slot, std::string key, std::string callee)
    : L_(L), slot_(slot), key_(std::move(key)), callee_(std::move(callee)) {}

// The error keeps its own position, which is where the user's function went
// wrong; the place of the call that evaluated it is appended.
void Function::call(int count, int results) const {
  if (lua_pcall(L_, count, results, 0) == LUA_OK) return;
  if (interrupted()) {
    lua_pop(L_, 1);
    throw Interrupted();  // caught where a result so far can be given
  }
  if (lua_type(L_, -1) == LUA_TSTRING) {
    auto place = position(L_);
    if (!place.empty()) place = " at " + place.substr(0, place.size() - 2);
    const auto what = key_.empty() ? "in the function given to " + callee_ : "in '" + key_ + "' of " + callee_;
    const std::string message = lua_tostring(L_, -1), where = " (" + what + place + ")";
    if (message.find(where) == std::string::npos) lua_pushstring(L_, (message + where).c_str());  // nested ones say it once
  }
  lua_error(L_);
}

void Function::begin(int count) const {
  luaL_checkstack(L_, count + 8, "too many arguments");
  lua_pushvalue(L_, slot_);
}

void Function::call(std::span<const double> arguments, int results) const {
  begin(static_cast<int>(arguments.size()));
  for (const double x : arguments) lua_pushnumber(L_, x);
  call(static_cast<int>(arguments.size()), results);
}

bool Function::finish(int count) const {
  const int base = lua_gettop(L_) - count - 1;
  call(count, LUA_MULTRET);
  const bool truth = lua_gettop(L_) == base || lua_toboolean(L_, base + 1) || lua_isnil(L_, base + 1);
  lua_settop(L_, base);
  return truth;
}

void Function::numbers(std::span<const double> arguments, std::span<double> values, bool infinite) const {
  const int base = lua_gettop(L_);
  call(arguments, LUA_MULTRET);

  const auto fail = [&](const std::string& what) {
    const auto name = key_.empty() ? std::string("function") : "function '" + key_ + "'";
    throw std::runtime_error(name + " returned " + what + " at " + point_text(arguments));
  };
  const auto given = static_cast<std::size_t>(lua_gettop(L_) - base);
  const auto wanted = "expected " + (values.size() == 1 ? "a number" : counted(values.size(), "number"));
  if (given == 0) fail("nothing");
  for (std::size_t i = 0; i < std::min(given, values.size()); ++i) {
    const int index = base + 1 + static_cast<int>(i);
    if (lua_type(L_, index) != LUA_TNUMBER) {
      const bool packed = lua_istable(L_, index) && values.size() > 1;
      fail(describe_value(L_, index) + (packed ? " (write: return fx, fy)" : ", " + wanted));
    }
    values[i] = lua_tonumber(L_, index);
    if (std::isnan(values[i]) || (std::isinf(values[i]) && !infinite)) fail(std::isnan(values[i]) ? "nan (not a number)" : number_text(values[i]));
  }
  if (given != values.size()) fail(counted(given, "number") + ", " + wanted);
  lua_settop(L_, base);
}

std::vector<double> Function::numbers(std::span<const double> arguments, std::size_t count) const {
  std::vector<double> values(count);
  numbers(arguments, values);
  return values;
}

std::string Function::text() const {
  begin(0);
  call(0, 1);
  if (lua_type(L_, -1) != LUA_TSTRING) throw std::runtime_error("function '" + key_ + "' returned " + describe_value(L_, -1) + ", expected a string");
  const auto text = read_value<std::string>(L_, -1);
  lua_pop(L_, 1);
  return text;
}

bool Function::truth(std::span<const double> arguments) const {
  call(arguments, 1);
  const bool truth = lua_toboolean(L_, -1);
  lua_pop(L_, 1);
  return truth;
}

std::shared_ptr<void> Function::object(std::span<const double> arguments, const char* type) const {
  call(arguments, 1);
  if (!object_at(L_, -1, type))
    throw std::runtime_error("function '" + key_ + "' returned " + describe_value(L_, -1) + ", expected " + with_article(type) + ", at " + point_text(arguments));
  auto found = checked_object(L_, -1, type);
  lua_pop(L_, 1);
  return found;
}

Field::Field(std::vector<double> constant) : components_(constant.size()), constant_(std::move(constant)) {}

Field::Field(Function function, std::size_t components)
    : components_(components), functions_{std::move(function)} {}

void Field::at(std::span<const double> point, std::span<double> values) const {
  if (constant()) {
    std::copy(constant_.begin(), constant_.end(), values.begin());
  } else {
    functions_.front().numbers(point, values.first(components_));
  }
}

std::vector<double> Field::operator()(std::span<const double> point) const {
  std::vector<double> values(components_);
  at(point, values);
  return values;
}

}  // namespace dotyk::script

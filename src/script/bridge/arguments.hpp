#pragma once
// The arguments of a call, checked against its descriptor and read by name.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/function.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {

// A call that does not fit its descriptor. The text has no position and no
// name of the callable; the guard adds both.
struct ArgumentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws ArgumentError unless the value at index is what `key` asks for;
// `what` names the value in the message: "'E'", "argument 1 'name'".
void check_value(lua_State* L, int index, const Key& key, const std::string& what);

// What read(stack index) makes of each entry of the list at index.
template <class Read>
auto read_list(lua_State* L, int index, Read&& read) {
  std::vector<decltype(read(index))> values;
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, index, i);
    values.push_back(read(lua_gettop(L)));
    lua_pop(L, 1);
  }
  return values;
}

// The value at index, which was checked: a number, a truth, a string, or a list of one of these or of lists.
template <class T>
T read_value(lua_State* L, int index) {
  if constexpr (std::is_same_v<T, bool>) {
    return lua_toboolean(L, index);
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(lua_tointeger(L, index));
  } else if constexpr (std::is_arithmetic_v<T>) {
    return lua_tonumber(L, index);
  } else if constexpr (std::is_same_v<T, std::string>) {
    std::size_t length = 0;
    const char* start = lua_tolstring(L, index, &length);
    return {start, length};
  } else {
    return read_list(L, index, [L](int at) { return read_value<typename T::value_type>(L, at); });
  }
}

// Named values, checked. The accessors return what the descriptor promises: the
// value given, else the key's fallback. Asking for a value that is neither, or
// for a name the descriptor does not have, throws std::logic_error: it is a
// mistake in a binding, not in a script.
class Arguments {
 public:
  // Opens the table at index: checks every key and item against `table` (of
  // Kind::table). Leaves the values on the Lua stack, where they stay until the
  // call ends. `place` is put before messages ("left: ").
  Arguments(lua_State* L, int index, const Key& table, std::string callee, const std::string& place = "");

  bool has(const std::string& name) const;               // given, and not nil
  bool known(const std::string& name) const;             // given, or the key has a fallback
  bool is(const std::string& name, int lua_type) const;  // given, of this Lua type: LUA_TFUNCTION, …

  template <class T>
  T value(const std::string& name) const {
    const auto [key, at] = find(name);
    using Kept = std::conditional_t<std::is_same_v<T, bool> || !std::is_arithmetic_v<T>, T, double>;  // see Key::default_value
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
      if (const auto* fallback = std::get_if<Kept>(&key.default_value); fallback && at == 0) return static_cast<T>(*fallback);
    return read_value<T>(L_, slot(name));
  }
  double number(const std::string& name) const { return value<double>(name); }
  long long integer(const std::string& name) const { return value<long long>(name); }
  bool boolean(const std::string& name) const { return value<bool>(name); }
  std::string text(const std::string& name) const { return value<std::string>(name); }  // a string or a choice
  std::vector<double> vector(const std::string& name) const { return value<std::vector<double>>(name); }
  std::vector<long long> integers(const std::string& name) const { return value<std::vector<long long>>(name); }
  std::vector<std::string> texts(const std::string& name) const { return value<std::vector<std::string>>(name); }
  std::vector<std::vector<double>> matrix(const std::string& name) const { return value<std::vector<std::vector<double>>>(name); }

  std::size_t choice(const std::string& name) const { return find(name).first.which(text(name)); }  // which of the key's choices
  template <class Enum>
  Enum choice(const std::string& name) const {  // what that stands for
    return static_cast<Enum>(find(name).first.values.at(choice(name)));
  }
  template <class Enum>
  std::vector<Enum> choices(const std::string& name) const {  // what the choices of a list stand for
    const Key& item = find(name).first.items.front();
    std::vector<Enum> all;
    for (const std::string& text : texts(name)) all.push_back(static_cast<Enum>(item.values.at(item.which(text))));
    return all;
  }
  Function function(const std::string& name) const { return {L_, slot(name), name, callee_}; }
  // With this many components; throws ArgumentError when a constant has others.
  Field field(const std::string& name, std::size_t components = 1) const;
  Arguments table(const std::string& name) const;
  std::vector<Arguments> tables(const std::string& name) const;  // a list of tables, none where it is not given

  // Into a variable, by its type; what is neither given nor has a fallback stays as it is.
  template <class Value>
  void read(const std::string& name, Value& into) const;
  // Sets what keys are bound to in the struct (Key::into), as read() does.
  template <class Struct>
  void fill(Struct& into) const {
    for (const Key& key : *keys_)
      for (const Key::Target& target : key.targets)
        if (*target.type == typeid(Struct)) target.set(*this, &into);
  }
  template <class Struct>
  Struct filled() const {
    Struct into{};
    fill(into);
    return into;
  }

  template <class T>
  std::shared_ptr<T> object(const std::string& name) const {
    return script::object<T>(L_, slot(name));
  }
  // Is an object of this class given (of a key that takes several kinds)?
  template <class T>
  bool holds(const std::string& name) const {
    return has(name) && object_at(L_, slot(name), Wrapped<T>::name);
  }
  // The stack index of a value kept with the object at object_index, 0 if none.
  int kept(int object_index, const std::string& name) const;
  // A function kept with an object; empty or one.
  std::vector<Function> kept_function(int object_index, const std::string& name) const;
  // The objects of a list.
  template <class T>
  std::vector<std::shared_ptr<T>> objects(const std::string& name) const {
    return objects_at<T>(slot(name));
  }
  // The items of the table itself.
  template <class T>
  std::vector<std::shared_ptr<T>> items() const {
    return objects_at<T>(table_);
  }
  std::size_t item_count() const { return lua_rawlen(L_, table_); }

  // The absolute stack index of a value that is given.
  int slot(const std::string& name) const;
  lua_State* state() const { return L_; }

 protected:
  Arguments(lua_State* L, std::string callee) : L_(L), callee_(std::move(callee)) {}
  // The key, and the stack index of its value, 0 where none is given.
  std::pair<const Key&, int> find(const std::string& name) const;

  template <class T>
  std::vector<std::shared_ptr<T>> objects_at(int index) const {
    return read_list(L_, index, [this](int at) { return script::object<T>(L_, at); });
  }

  lua_State* L_;
  std::string callee_;
  int table_ = 0;  // stack index of the table, 0 for positional arguments
  const std::vector<Key>* keys_ = nullptr;
  std::vector<int> slots_;  // stack index of each key's value, 0 when absent
};

template <class Value>
void Arguments::read(const std::string& name, Value& into) const {
  if (!known(name)) return;
  if constexpr (std::is_enum_v<Value>) {
    into = choice<Value>(name);
  } else if constexpr (requires { into.emplace(); }) {  // std::optional
    read(name, into.emplace());
  } else if constexpr (requires { std::tuple_size<Value>::value; }) {  // std::array
    std::copy_n(vector(name).begin(), into.size(), into.begin());
  } else if constexpr (std::is_same_v<Value, bool>) {
    into = find(name).first.kind == Kind::choice ? choice<bool>(name) : boolean(name);
  } else if constexpr (std::is_integral_v<Value>) {
    into = static_cast<Value>(std::min<long long>(integer(name), std::numeric_limits<Value>::max()));
  } else {
    into = value<Value>(name);
  }
}

template <class Struct, class Member>
Key& Key::into(Member member) {
  Struct standard{};
  const auto own = member(standard);  // the default
  using Value = std::remove_const_t<decltype(own)>;
  if (!needed && default_text.empty()) {
    if constexpr (std::is_same_v<Value, bool>) {
      kind == Kind::choice ? choice_fallback(own) : fallback(own);
    } else if constexpr (std::is_arithmetic_v<Value>) {
      if (in_range(own)) fallback(static_cast<double>(own));
    } else if constexpr (requires { fallback(own); }) {
      fallback(own);
    }
  }
  const auto set = [key = name, member](const Arguments& from, void* all) { from.read(key, member(*static_cast<Struct*>(all))); };
  targets.push_back({&typeid(Struct), set});
  return *this;
}

}  // namespace dotyk::script

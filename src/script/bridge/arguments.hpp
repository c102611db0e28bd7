#pragma once
// The arguments of a call, checked against its descriptor and read by name.
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "script/bridge/descriptor.hpp"
#include "script/bridge/function.hpp"
#include "script/bridge/object.hpp"

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

// The numbers of the list at index.
std::vector<double> read_vector(lua_State* L, int index);

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

  double number(const std::string& name) const;
  long long integer(const std::string& name) const;
  bool boolean(const std::string& name) const;
  std::string text(const std::string& name) const;    // a string or a choice
  std::size_t choice(const std::string& name) const;  // which of the key's choices
  bool is_choice(const std::string& name) const { return find(name).first.kind == Kind::choice; }
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
  std::vector<double> vector(const std::string& name) const;
  std::vector<long long> integers(const std::string& name) const;  // a list of integers
  std::vector<std::string> texts(const std::string& name) const;   // a list of strings
  std::vector<std::vector<double>> matrix(const std::string& name) const;
  Function function(const std::string& name) const;
  // Sets what keys are bound to in the struct (Key::into); what is neither given nor has a fallback stays as it is.
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
  // Into a variable, by its type (see take() in bound.hpp); what is neither given nor has a fallback stays as it is.
  template <class Value>
  void read(const std::string& name, Value& into) const {
    if (known(name)) take(*this, name, into);
  }
  // With this many components; throws ArgumentError when a constant has others.
  Field field(const std::string& name, std::size_t components = 1) const;
  Arguments table(const std::string& name) const;
  std::vector<Arguments> tables(const std::string& name) const;  // a list of tables, none where it is not given

  template <class T>
  std::shared_ptr<T> object(const std::string& name) const {
    return script::object<T>(L_, slot(name));
  }
  // Is an object of this class given (of a key that takes several kinds)?
  template <class T>
  bool holds(const std::string& name) const {
    return has(name) && object_at(L_, slot(name), Wrapped<T>::name);
  }
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
  std::size_t item_count() const;

  // The absolute stack index of a value that is given.
  int slot(const std::string& name) const;
  lua_State* state() const { return L_; }

 protected:
  Arguments(lua_State* L, std::string callee) : L_(L), callee_(std::move(callee)) {}
  // The key, and the stack index of its value, 0 where none is given.
  std::pair<const Key&, int> find(const std::string& name) const;
  // The key's fallback, when it has one of this type and no value is given; else null.
  template <class T>
  const T* fallback_of(const std::string& name) const;

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

}  // namespace dotyk::script

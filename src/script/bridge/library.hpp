#pragma once
// Everything a script can call, by name: the source of help, completion and the reference page.
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/place.hpp"
#include "script/bridge/call.hpp"
#include "script/bridge/descriptor.hpp"

namespace dotyk::script {

// A field of an object: computed when read.
struct TypeField {
  std::string name, help, units;
  std::function<void(lua_State*, const std::shared_ptr<void>&)> read;
};

// A class of objects as scripts see it.
struct Type {
  std::string name, help;
  std::string setup;  // Lua that makes what the methods' examples start from, where they have no setup of their own
  std::deque<TypeField> fields;
  std::deque<Descriptor> methods;
  std::function<std::string(const void*)> text;  // for print(); "<name>" if empty

  std::vector<std::string> member_names() const;
  const Descriptor* method(const std::string& method_name) const;
  const TypeField* field(const std::string& field_name) const;
};

// A table of functions, "dotyk.mesh", with a line of help.
struct Module {
  std::string name, help;
};

// The descriptor behind the function at index, or null.
const Descriptor* descriptor_at(lua_State* L, int index);

class Manifest;

template <class T>
class TypeOf;

// Registers callables and classes in a Lua state and remembers their
// descriptions. Lives as long as the state.
class Library {
 public:
  explicit Library(lua_State* L);
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  // The library of a state (or of any of its coroutines).
  static Library& of(lua_State* L);

  // A function under its dotted name: "dotyk.mesh.box" goes into the table
  // dotyk.mesh, made on the way; a name without dots becomes a global.
  void function(Descriptor descriptor);

  // The text help shows for a table of functions.
  void module(std::string name, std::string help);

  // A class; Wrapped<T>::name is its name.
  template <class T>
  TypeOf<T> type(std::string help) {
    return {*this, add_type(Wrapped<T>::name, std::move(help))};
  }
  // More members for a class described elsewhere.
  template <class T>
  TypeOf<T> extend() {
    return {*this, known_type(Wrapped<T>::name)};
  }
  void add_method(Type& type, Descriptor descriptor);

  const std::deque<Descriptor>& functions() const { return functions_; }
  const std::deque<Type>& types() const { return types_; }
  const std::deque<Module>& modules() const { return modules_; }

  // By name; null if there is none. find() takes functions and methods, by full name ("dotyk.solve", "part:load").
  const Type* find_type(const std::string& name) const;
  const Descriptor* find(const std::string& name) const;
  // Every name find() and find_type() know.
  std::vector<std::string> names() const;

  // Where the script's files must be (--safe); none: anywhere.
  std::optional<Folder> folder;

  // What is written beside every file that a call writes (--manifest), or null.
  std::shared_ptr<const Manifest> manifest;

  // The class of the object at index, null for any other value.
  const Type* type_at(lua_State* L, int index) const;
  // The module the table at index is, empty for any other value.
  std::string module_at(lua_State* L, int index) const;

 private:
  Type& add_type(const char* name, std::string help);
  Type& known_type(const std::string& name);  // throws std::logic_error
  void open_module(const std::string& path);

  lua_State* L_;
  std::deque<Descriptor> functions_;
  std::deque<Type> types_;
  std::deque<Module> modules_;
};

// Describes the members of a class, one call each.
template <class T>
class TypeOf {
 public:
  TypeOf(Library& library, Type& type) : library_(library), type_(type) {}

  // `get` takes a const T& and returns anything push() knows; or is a member.
  template <class Get>
  TypeOf& field(std::string name, std::string help, Get get, std::string units = "") {
    const auto read = [get](lua_State* L, const std::shared_ptr<void>& object) {
      push(L, std::invoke(get, *static_cast<const T*>(object.get())));
    };
    type_.fields.push_back({std::move(name), std::move(help), std::move(units), read});
    return *this;
  }

  // What the examples of the methods described from here on start from.
  TypeOf& setup(std::string text) {
    type_.setup = std::move(text);
    return *this;
  }

  // The descriptor's name is "type:method".
  TypeOf& method(Descriptor descriptor) {
    library_.add_method(type_, std::move(descriptor));
    return *this;
  }

  // What print() shows.
  TypeOf& text(std::function<std::string(const T&)> show) {
    type_.text = [show](const void* object) { return show(*static_cast<const T*>(object)); };
    return *this;
  }

 private:
  Library& library_;
  Type& type_;
};

}  // namespace dotyk::script

#pragma once
// One description per callable. It drives registration, the checking of
// arguments, help(), completion, the reference page and the completeness test.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <variant>
#include <vector>

namespace dotyk::script {

class Arguments;
class Call;

// What a value given by a script may be.
enum class Kind {
  number,   // finite unless said otherwise, within [least, greatest]
  integer,  // a number without a fraction
  boolean,
  string,
  file,    // the name of a file: under --safe one below the folder given
  choice,  // one of a few strings
  vector,  // a table of numbers
  matrix,  // a table of tables of numbers
  field,   // a number or a vector, or a function of the coordinates
  function,
  object,  // one of dotyk's own: a body, a mesh, …
  list,    // a table of items of one kind
  table,   // a table of keys, and perhaps of items
  either,  // one of several kinds
  any
};

// One argument, or one key of a table argument. Built by the functions of
// namespace key below and completed by chained calls:
//   key::number("nu", "Poisson's ratio").within(-1, 0.5).into(&Plate::nu)
struct Key {
  // Sets a member of a struct of this type.
  struct Target {
    const std::type_info* type;
    std::function<void(const Arguments& from, void* into)> set;
  };

  std::string name;
  Kind kind = Kind::any;
  std::string help;
  std::string units;
  std::string default_text;
  std::variant<std::monostate, double, bool, std::string> default_value;
  bool needed = false;
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool least_excluded = false, greatest_excluded = false;
  bool infinite = false;   // math.huge is a value
  bool gaps = false;       // so is nan, in a vector or a matrix: there is none
  bool output = false;     // a file that the call writes
  std::size_t fewest = 0;  // entries of a vector, items of a list or table
  std::size_t most = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> choices;
  std::vector<int> values;  // what the choices stand for, where that is an enumeration or a bool
  std::string type;        // of an object
  std::vector<Key> keys;   // of a table; the kinds of an either
  std::vector<Key> items;  // one entry describing each item of a list or table
  std::vector<Target> targets;  // what takes the value, see into()
  std::function<std::vector<std::string>(const void* object)> names;  // strings that mean something to a method's object; see of()

  Key& required() { return set(needed, true); }                        // absent is an error
  Key& unit(std::string text) { return set(units, std::move(text)); }  // "stress", "length"
  Key& fallback(double value);                                         // taken when absent, and shown by help
  Key& fallback(bool value);
  Key& fallback(const char* value);
  template <class Enum>
  requires std::is_enum_v<Enum>
  Key& fallback(Enum value) {
    return choice_fallback(static_cast<int>(value));
  }
  Key& otherwise(std::string text) { return set(default_text, std::move(text)); }               // what happens when absent, in words
  Key& above(double value) { return set(least, value).set(least_excluded, true); }              // value < x
  Key& below(double value) { return set(greatest, value).set(greatest_excluded, true); }        // x < value
  Key& at_least(double value) { return set(least, value).set(least_excluded, false); }          // value <= x
  Key& within(double low, double high) { return set(least, low).set(greatest, high); }
  Key& or_infinite() { return set(infinite, true); }                                            // math.huge as well
  Key& count(std::size_t exactly) { return count(exactly, exactly); }                           // entries or items
  Key& count(std::size_t least_count, std::size_t most_count) { return set(fewest, least_count).set(most, most_count); }
  Key& or_nan() { return set(gaps, true); }                                                     // entries that are nan as well
  Key& some() { return count(1, std::numeric_limits<std::size_t>::max()); }                     // at least one
  Key& written() { return set(output, true); }                                                  // the call writes this file
  Key& with(Key item) { return set(items, {std::move(item)}); }                                 // a table that takes items as well as keys
  // A member of a struct that takes the value (Arguments::fill), or a function of the struct that gives a reference. What no
  // value is given for stays as the struct has it, which is the default that help shows, unless the key is required, says
  // otherwise before, or would refuse it. Defined in arguments.hpp.
  template <class Struct, class Value>
  Key& into(Value Struct::* member) {
    return into<Struct>([member](Struct& all) -> Value& { return all.*member; });
  }
  template <class Struct, class Member>
  Key& into(Member member);
  // Names that the method's object, a T, brings: completion offers them.
  template <class T, class Names>
  Key& of(Names found) {
    names = [found](const void* object) { return found(*static_cast<const T*>(object)); };
    return *this;
  }

  // Is it within [least, greatest]?
  bool in_range(double value) const {
    return (least_excluded ? value > least : value >= least) && (greatest_excluded ? value < greatest : value <= greatest);
  }

  // Which of the choices.
  std::size_t which(const std::string& text) const {
    return static_cast<std::size_t>(std::find(choices.begin(), choices.end(), text) - choices.begin());
  }

  // "a positive number", "one of "strain" or "stress"", "a body": completes "expected …".
  std::string expected() const;

 private:
  Key& choice_fallback(int value);
  template <class T>
  Key& set(T& member, std::type_identity_t<T> value) {
    member = std::move(value);
    return *this;
  }
};

// These keys, then those.
std::vector<Key> joined(std::vector<Key> these, const std::vector<Key>& those);
std::vector<std::string> names_of(const std::vector<Key>& keys);
// The named keys of a table, or of the tables among the kinds of an either.
std::vector<Key> named_keys(const Key& key);
// These, and those of its items.
std::vector<Key> inner_keys(const Key& key);

// One result that is pushed already: the object before the colon again, or an object with what it keeps.
struct OneResult {};
struct Self : OneResult {};
template <class T>
struct Given : OneResult {
  using element_type = T;
};

// What stands behind a callable: a function of the call. It gives an int, the number of results that it has pushed, or one of
// the above; or nothing; or a value that push() knows. Where that is an object, it tells what the callable returns.
class Runner {
 public:
  Runner() = default;
  template <class Function>
  requires std::is_invocable_v<Function, Call&>
  Runner(Function function);
  explicit operator bool() const { return static_cast<bool>(run_); }
  int operator()(Call& call) const { return run_(call); }  // returns the number of results pushed
  const std::string& returns() const { return returns_; }  // a type, ":" for the one of the object before the colon, else empty

 private:
  std::function<int(Call&)> run_;
  std::string returns_;
};

// A function in a file of lua/.
struct LuaFunction {
  std::string file, name;
};

// A Lua callable: its text, its arguments and the function behind it.
struct Descriptor {
  std::string name = {};               // "dotyk.material", or "body:part" for a method
  std::string help = {};               // a paragraph
  std::string setup = {};              // Lua that makes what the example starts from; shown with it
  std::string example = {};            // Lua that runs after the setup, in any folder that can be written to
  std::vector<Key> arguments = {};     // in order; or a single unnamed table
  std::string returns = {};            // type of the result, for completion after a call, and for help; mostly `run` tells
  Runner run = {};
  LuaFunction in_lua = {};             // in place of run: it gets the arguments checked, a table copied and with its fallbacks filled in

  std::string short_name() const;  // "material", "part": what errors begin with
  std::string owner() const;       // "body" for "body:part", else empty
  bool takes_table() const;        // called with one table of keys
  std::vector<Key> keys() const;   // the arguments; of a table its items and its keys
  std::string signature() const;   // "dotyk.material{ E, nu = 0.3 }"
  std::string whole_example() const;  // setup and example: a script
};

template <class T>
struct Wrapped;  // see push.hpp

namespace key {
template <Kind kind>
Key plain(std::string name, std::string help);
inline constexpr auto number = plain<Kind::number>;
inline constexpr auto integer = plain<Kind::integer>;
inline constexpr auto boolean = plain<Kind::boolean>;
inline constexpr auto string = plain<Kind::string>;
inline constexpr auto file = plain<Kind::file>;
inline constexpr auto vector = plain<Kind::vector>;
inline constexpr auto matrix = plain<Kind::matrix>;
inline constexpr auto field = plain<Kind::field>;
inline constexpr auto function = plain<Kind::function>;
inline constexpr auto any = plain<Kind::any>;
Key positive(std::string name, std::string help);  // a number above 0
Key choice(std::string name, std::vector<std::string> choices, std::string help);
// Names of the values of an enumeration, or of true and false; Arguments::choice<Enum> gives the value.
template <class Enum>
Key choice(std::string name, const std::vector<std::pair<const char*, Enum>>& choices, std::string help) {
  Key key = choice(std::move(name), std::vector<std::string>(), std::move(help));
  for (const auto& [text, value] : choices) key.choices.push_back(text), key.values.push_back(static_cast<int>(value));
  return key;
}
Key list(std::string name, Key item, std::string help);
Key table(std::string name, std::vector<Key> keys, std::string help);
Key table(std::vector<Key> keys);  // the single table argument of a call
Key either(std::string name, std::vector<Key> kinds, std::string help);

template <Kind kind>
Key plain(std::string name, std::string help) {
  Key key;
  key.name = std::move(name), key.kind = kind, key.help = std::move(help);
  return key;
}
template <class T>
Key object(std::string name, std::string help) {
  Key key = plain<Kind::object>(std::move(name), std::move(help));
  key.type = Wrapped<T>::name;
  return key;
}
}  // namespace key

// A number as a person would write it: "0.3", "1e-10", "5".
std::string number_text(double value);

// "bodies", "1 body" or "2 bodies", "a body" or "an element".
std::string plural(const std::string& noun);
std::string counted(std::size_t count, const std::string& noun);
std::string with_article(const std::string& noun);

}  // namespace dotyk::script

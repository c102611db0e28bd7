#pragma once
// One description per callable. It drives registration, the checking of
// arguments, help(), completion, the reference page and the completeness test.
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace dotyk::script {

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
//   key::number("nu", "Poisson's ratio").within(-1, 0.5).fallback(0.3)
struct Key {
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
  bool output = false;     // a file that the call writes
  std::size_t fewest = 0;  // entries of a vector, items of a list or table
  std::size_t most = std::numeric_limits<std::size_t>::max();
  std::vector<std::string> choices;
  std::string type;        // of an object
  std::vector<Key> keys;   // of a table; the kinds of an either
  std::vector<Key> items;  // one entry describing each item of a list or table
  std::function<std::vector<std::string>(const void* object)> names;  // strings that mean something to a method's object; see of()

  Key& required();              // absent is an error
  Key& unit(std::string text);  // "stress", "length"
  Key& fallback(double value);  // taken when absent, and shown by help
  Key& fallback(bool value);
  Key& fallback(const char* value);
  Key& otherwise(std::string text);  // what happens when absent, in words
  Key& above(double value);          // value < x
  Key& below(double value);          // x < value
  Key& at_least(double value);       // value <= x
  Key& within(double least_value, double greatest_value);
  Key& or_infinite();               // math.huge as well
  Key& count(std::size_t exactly);  // entries or items
  Key& count(std::size_t fewest_count, std::size_t most_count);
  Key& written();       // the call writes this file
  Key& with(Key item);  // a table that takes items as well as keys
  // Names that the method's object, a T, brings: completion offers them.
  template <class T, class Names>
  Key& of(Names found) {
    names = [found](const void* object) { return found(*static_cast<const T*>(object)); };
    return *this;
  }

  // "a positive number", "one of "strain" or "stress"", "a body": completes "expected …".
  std::string expected() const;
};

// The named keys of a table, or of the tables among the kinds of an either.
std::vector<Key> named_keys(const Key& key);

// A Lua callable: its text, its arguments and the C++ function behind it.
struct Descriptor {
  std::string name = {};               // "dotyk.material", or "body:part" for a method
  std::string help = {};               // a paragraph
  std::string setup = {};              // Lua that makes what the example starts from; shown with it
  std::string example = {};            // Lua that runs after the setup, in any folder that can be written to
  std::vector<Key> arguments = {};     // in order; or a single unnamed table
  std::string returns = {};            // type of the result, for completion after a call, and for help
  std::function<int(Call&)> run = {};  // returns the number of results pushed

  std::string short_name() const;  // "material", "part": what errors begin with
  std::string owner() const;       // "body" for "body:part", else empty
  bool takes_table() const;        // called with one table of keys
  std::string signature() const;   // "dotyk.material{ E, nu = 0.3 }"
  std::string whole_example() const;  // setup and example: a script
};

template <class T>
struct Wrapped;  // see object.hpp

namespace key {
Key number(std::string name, std::string help);
Key positive(std::string name, std::string help);  // a number above 0
Key integer(std::string name, std::string help);
Key boolean(std::string name, std::string help);
Key string(std::string name, std::string help);
Key file(std::string name, std::string help);
Key choice(std::string name, std::vector<std::string> choices, std::string help);
Key vector(std::string name, std::string help);
Key matrix(std::string name, std::string help);
Key field(std::string name, std::string help);
Key function(std::string name, std::string help);
Key object(std::string name, std::string type, std::string help);
Key list(std::string name, Key item, std::string help);
Key table(std::string name, std::vector<Key> keys, std::string help);
Key table(std::vector<Key> keys);  // the single table argument of a call
Key either(std::string name, std::vector<Key> kinds, std::string help);
Key any(std::string name, std::string help);

template <class T>
Key object(std::string name, std::string help) {
  return object(std::move(name), Wrapped<T>::name, std::move(help));
}
}  // namespace key

// A number as a person would write it: "0.3", "1e-10", "5".
std::string number_text(double value);

// "body" → "bodies".
std::string plural(const std::string& noun);

// "a body", "an element".
std::string with_article(const std::string& noun);

}  // namespace dotyk::script

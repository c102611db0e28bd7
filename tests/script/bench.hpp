#pragma once
// An interpreter with a few callables that exist for the tests only.
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "script/interpreter.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::script {

struct Toy {
  std::string name;
  double size = 1;
};
struct Other {};
template <> struct Wrapped<Toy> : Called<"toy"> {};
template <> struct Wrapped<Other> : Called<"other"> {};

// dotyk.test.* and the class toy. `last` collects what the callables were given.
class Bench {
 public:
  Bench();

  // The error message of the text, "" when there is none. The chunk is called "t.lua".
  std::string error(const std::string& text) { return interpreter.run_text(text, "t.lua").value_or(""); }

  Interpreter interpreter;
  std::vector<double> numbers;
  std::string text;
  std::vector<std::weak_ptr<Toy>> toys;
};

}  // namespace dotyk::script

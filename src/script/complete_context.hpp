#pragma once
// What stands before the cursor? A small reading of unfinished Lua, without
// running any of it.
#include <cstddef>
#include <string>
#include <vector>

namespace dotyk::script {

// One step of `scene:contact{…}.force`: a name, or a call.
struct Step {
  enum Kind { name, field, method, call } kind;
  std::string text;
};
using Chain = std::vector<Step>;

// An open bracket: what is called with it, if anything, and the key it is the
// value of, if any ("left" in beam{ left = { ).
struct Bracket {
  char sign = 0;
  Chain callee;
  std::string key;
};

struct Context {
  std::size_t start = 0;          // where the word at the cursor begins
  std::string word;               // what is there of it
  Chain chain;                    // what the word belongs to: chain.word, chain:word
  Step::Kind joint = Step::name;  // name (nothing before it), field or method
  std::vector<Bracket> brackets;  // the open ones, outermost first
  bool in_string = false;         // the cursor stands in a string, which begins at start
  bool key_position = false;      // the word may be a key: after { or ,
  std::string value_of;           // the key whose value is being written
};

Context read_context(const std::string& text);

}  // namespace dotyk::script

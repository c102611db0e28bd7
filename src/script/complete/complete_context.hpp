#pragma once
// What stands before the cursor? A small reading of unfinished Lua, without
// running any of it; and Lua cut into tokens.
#include <cstddef>
#include <string>
#include <vector>

namespace dotyk::script {

struct Token {
  enum Kind { name, keyword, number, string, sign, end } kind;
  std::size_t begin, after;  // where it stands in the text, a string with its quotes or brackets
  bool open = false;         // the text ends within this quoted string, or, at the end, within a comment
};

// The first token from there on, behind blanks and comments. Signs are single letters but for "..", "::" and "==".
Token next_token(const std::string& text, std::size_t at);

const std::vector<std::string>& lua_keywords();

// May it stand after a dot, or for a variable?
bool is_name(const std::string& word);

// One step of `scene:contact{…}.force`, a name or a call, or of `t[3]`: an item,
// its number (empty where it is anything but a plain one).
struct Step {
  enum Kind { name, field, method, call, item } kind;
  std::string text;
};
using Chain = std::vector<Step>;

// An open bracket: what is called with it (or, after a [, indexed), if anything,
// and the key it is the value of, if any ("left" in beam{ left = { ).
struct Bracket {
  char sign = 0;
  Chain callee;
  std::string key;
  std::size_t begin = 0;     // of what stands in it
  std::size_t finished = 0;  // entries before the cursor's
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
  bool value_position = false;    // nothing of that value, or of an argument, is there yet but the word
};

Context read_context(const std::string& text);

}  // namespace dotyk::script

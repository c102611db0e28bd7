#pragma once
// Lua cut into tokens, unfinished text too.
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

}  // namespace dotyk::script

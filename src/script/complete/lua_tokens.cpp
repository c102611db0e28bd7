#include "script/complete/lua_tokens.hpp"

#include <algorithm>
#include <cctype>

namespace dotyk::script {
namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool continues_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)); }

// The place after [[ … ]] or [=[ … ]=]; `at` where none begins there.
std::size_t after_long_bracket(const std::string& text, std::size_t at) {
  const auto second = text.find_first_not_of('=', at + 1);
  if (text[at] != '[' || second == std::string::npos || text[second] != '[') return at;
  const auto closing = "]" + std::string(second - at - 1, '=') + "]";
  const auto found = text.find(closing, second);
  return found == std::string::npos ? text.size() : found + closing.size();
}

std::size_t after_comment(const std::string& text, std::size_t at) {
  const auto after = at + 2 < text.size() ? after_long_bracket(text, at + 2) : at + 2;
  return after > at + 2 ? after : std::min(text.find('\n', at), text.size());
}

// Of a string that the end of its line ends, too.
Token quoted(const std::string& text, std::size_t at) {
  auto end = at + 1;
  while (end < text.size() && text[end] != text[at] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
  return {Token::string, at, std::min(end + 1, text.size()), end >= text.size()};
}

}  // namespace

Token next_token(const std::string& text, std::size_t at) {
  bool in_comment = false;
  while (at < text.size() && (std::isspace(static_cast<unsigned char>(text[at])) || text.compare(at, 2, "--") == 0)) {
    in_comment = text[at] == '-';
    at = in_comment ? after_comment(text, at) : at + 1;
  }
  if (at >= text.size()) return {Token::end, at, at, in_comment};
  const auto all = [&](auto&& belongs) { return static_cast<std::size_t>(std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), belongs) - text.begin()); };
  const char c = text[at];
  if (begins_name(c)) {
    const auto after = all(continues_name);
    const auto& words = lua_keywords();
    return {std::count(words.begin(), words.end(), text.substr(at, after - at)) ? Token::keyword : Token::name, at, after};
  }
  if (std::isdigit(static_cast<unsigned char>(c))) return {Token::number, at, all([](char d) { return continues_name(d) || d == '.'; })};
  if (c == '"' || c == '\'') return quoted(text, at);
  if (const auto after = after_long_bracket(text, at); after > at) return {Token::string, at, after};
  const bool two = (c == '.' || c == ':' || c == '=') && at + 1 < text.size() && text[at + 1] == c;
  return {Token::sign, at, at + (two ? 2 : 1)};
}

const std::vector<std::string>& lua_keywords() {
  static const std::vector<std::string> words = {"and",      "break",  "do",   "else", "elseif", "end",   "false", "for",
                                                 "function", "goto",   "if",   "in",   "local",  "nil",   "not",   "or",
                                                 "repeat",   "return", "then", "true", "until",  "while"};
  return words;
}

bool is_name(const std::string& word) {
  const Token token = next_token(word, 0);
  return token.kind == Token::name && token.begin == 0 && token.after == word.size();
}

}  // namespace dotyk::script

#include "script/prompt/prompt_input.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "script/complete/lua_tokens.hpp"

namespace dotyk::script {

namespace {

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> all;
  for (Token token = next_token(text, 0); token.kind != Token::end; token = next_token(text, token.after))
    all.push_back(text.substr(token.begin, token.after - token.begin));
  return all;
}

// A name or a keyword.
bool is_word(const std::string& token) { return std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_'; }

}  // namespace

bool wants_out(const std::string& input) {
  auto tokens = tokens_of(input);
  if (!tokens.empty() && tokens.back() == ";") tokens.pop_back();
  if (tokens.size() == 3 && tokens[1] == "(" && tokens[2] == ")") tokens.resize(1);
  return tokens.size() == 1 && (tokens[0] == "exit" || tokens[0] == "quit");
}

std::string question(const std::string& input, const std::function<bool(const std::string&)>& is_variable) {
  const auto tokens = tokens_of(input);
  auto at = tokens.begin();
  const auto take = [&](const char* token) { return at != tokens.end() && *at == token && (++at, true); };
  const bool help = tokens.size() > 1 && is_word(tokens[1]) && take("help");
  const bool asked = help || take("?");
  if (at == tokens.end() || !is_word(*at)) return "";
  const std::string first = *at++;
  std::string rest;  // ".field:method"
  for (; tokens.end() - at >= 2 && (*at == "." || *at == ":") && is_word(at[1]); at += 2) rest += at[0] + at[1];
  if (!asked && !take("?")) return "";
  const bool source = !asked && take("?");
  if (at != tokens.end()) return "";
  if (!is_variable(first)) return "help \"" + first + rest + "\"";
  std::replace(rest.begin(), rest.end(), ':', '.');
  return (source ? "source(" : "help(") + first + rest + ")";
}

std::deque<std::string> lines_of(const std::string& text) {
  std::deque<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

bool goes_on_with(const std::string& line) {
  const auto tokens = tokens_of(line);
  if (tokens.empty()) return false;
  const std::string& first = tokens[0];
  if (first == ":") return tokens.size() > 1;
  return first == "and" || first == "or" || std::string(".+*/%^,=<>~)}]").find(first[0]) != std::string::npos;
}

}  // namespace dotyk::script

#include "script/complete/complete_context.hpp"

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

class ContextReader {
 public:
  explicit ContextReader(const std::string& text) : text_(text) {}

  Context read() {
    while (at_ < text_.size() && !context_.in_string) step();
    context_.value_of = key_;
    if (!context_.in_string) finish();
    return context_;
  }

 private:
  // What the next word may be: a key of a table; the beginning of a key's value or of an argument.
  struct Position {
    bool key = false, value = false;
  };

  void step() {
    token_ = next_token(text_, at_);
    const auto word = text_.substr(token_.begin, token_.after - token_.begin);
    at_ = token_.after;
    if (token_.kind == Token::number) operation();
    else if (token_.kind == Token::string) token_.open ? in_string(token_.begin + 1) : called();
    else if (token_.kind == Token::sign) sign(word);
    else if (token_.kind != Token::end) name(word);
  }

  void sign(const std::string& sign) {
    if (sign == "." || sign == ":") joined_ = sign == "." ? Step::field : Step::method;
    else if (sign == "(" || sign == "{" || sign == "[") open(sign[0]);
    else if (sign == ")" || sign == "}" || sign == "]") close(sign[0]);
    else if (sign == "," || sign == ";") separator();
    else if (sign == "=") equals();
    else operation();
  }

  void name(const std::string& word) {
    if (joined_ != Step::name) chain_.push_back({joined_, word});
    else if (token_.kind == Token::keyword) chain_.clear();
    else chain_ = {{Step::name, word}};
    began_ = next_;
    expect({});
  }

  void in_string(std::size_t start) {
    context_.in_string = true;
    context_.start = start;
    context_.word = text_.substr(start);
    context_.chain = chain_;
  }

  void open(char c) {
    context_.brackets.push_back({c, chain_, key_, at_, 0});
    key_.clear();
    chain_.clear();
    begin_entry();
  }

  // Behind an opening bracket or a separator.
  void begin_entry() {
    const auto& bracket = context_.brackets.back();
    expect({.key = bracket.sign == '{', .value = bracket.sign == '(' && !bracket.callee.empty()});
  }

  void close(char c) {
    operation();
    if (context_.brackets.empty()) return;
    const auto bracket = context_.brackets.back();
    context_.brackets.pop_back();
    key_ = bracket.key;
    chain_ = bracket.callee;
    if (c != ']') return called();
    if (!chain_.empty()) chain_.push_back(item(text_.substr(bracket.begin, at_ - 1 - bracket.begin)));
  }

  static Step item(const std::string& index) {
    const auto size = index.size();
    const bool quoted = size > 2 && (index[0] == '"' || index[0] == '\'') && index.find(index[0], 1) == size - 1;
    if (quoted && index.find('\\') == std::string::npos) return {Step::field, index.substr(1, size - 2)};
    const bool plain = size > 0 && size < 10 && index.find_first_not_of("0123456789") == std::string::npos;
    return {Step::item, plain ? index : ""};
  }

  // A string or a closed bracket after something calls it.
  void called() {
    if (!chain_.empty()) chain_.push_back({Step::call, ""});
    expect({});
  }

  void separator() {
    operation();
    key_.clear();
    if (context_.brackets.empty()) return;
    ++context_.brackets.back().finished;
    begin_entry();
  }

  void equals() {
    const bool is_key = began_.key && chain_.size() == 1 && !context_.brackets.empty() && context_.brackets.back().sign == '{';
    key_ = is_key ? chain_.front().text : "";
    operation();
    next_.value = is_key;
  }

  void operation() {
    chain_.clear();
    expect({});
  }

  void expect(Position next) {
    next_ = next;
    joined_ = Step::name;
  }

  void finish() {
    context_.start = text_.size();
    if (token_.kind == Token::end && token_.open) return;  // in a comment
    const bool touching = (token_.kind == Token::name || token_.kind == Token::keyword) && at_ == text_.size();
    if (touching) {
      context_.start = token_.begin;
      context_.word = text_.substr(token_.begin);
      if (chain_.empty()) return;  // a keyword, or the beginning of a longer name
      joined_ = chain_.back().kind;
      chain_.pop_back();
    }
    context_.joint = joined_;
    if (joined_ != Step::name) {
      context_.chain = chain_;
    } else {
      context_.key_position = (touching ? began_ : next_).key;
      context_.value_position = (touching ? began_ : next_).value;
    }
  }

  const std::string& text_;
  Context context_;
  std::size_t at_ = 0;
  Token token_{Token::end, 0, 0};  // the last one
  Chain chain_;
  std::string key_;                    // the key whose value is being read
  Step::Kind joined_ = Step::name;     // field, method: a '.' or ':' has just been read, after nothing that is known where the chain is empty
  Position next_, began_;              // of the next word; of the last one
};

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

Context read_context(const std::string& text) { return ContextReader(text).read(); }

}  // namespace dotyk::script

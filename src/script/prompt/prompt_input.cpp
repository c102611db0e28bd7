#include "script/prompt/prompt_input.hpp"

#include <cctype>

namespace dotyk::script {

namespace {

/// Reads a line from left to right. (std::regex goes as deep into the stack as its input is long.)
class InputReader {
 public:
  explicit InputReader(const std::string& text) : text_(text) {}

  InputReader& spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return *this;
  }
  bool take(const std::string& what) {
    if (text_.compare(at_, what.size(), what) != 0) return false;
    at_ += what.size();
    return true;
  }
  /// A name; empty: there is none.
  std::string name() {
    const std::size_t from = at_;
    const auto letter = [](unsigned char c) { return std::isalpha(c) || c == '_'; };
    while (at_ < text_.size() && (letter(text_[at_]) || (at_ > from && std::isdigit(static_cast<unsigned char>(text_[at_]))))) ++at_;
    return text_.substr(from, at_ - from);
  }
  /// ".field:method" after a name.
  std::string fields() {
    std::string all;
    for (std::size_t before = at_; at_ < text_.size() && (text_[at_] == '.' || text_[at_] == ':'); before = at_) {
      const char mark = text_[at_++];
      const std::string field = name();
      if (field.empty()) {
        at_ = before;
        break;
      }
      all += mark + field;
    }
    return all;
  }
  bool ended() { return spaces().at_ == text_.size(); }
  char next(std::size_t k = 0) const { return at_ + k < text_.size() ? text_[at_ + k] : '\0'; }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

bool wants_out(const std::string& input) {
  InputReader line(input);
  const std::string word = line.spaces().name();
  if (word != "exit" && word != "quit") return false;
  if (line.spaces().take("(") && !line.spaces().take(")")) return false;
  line.spaces().take(";");
  return line.ended();
}

std::string question(const std::string& input, const std::function<bool(const std::string&)>& is_variable) {
  InputReader line(input);
  std::string first, rest;
  bool source = false, asked = line.spaces().take("?");
  if (!asked) first = line.name();
  if (first == "help" && std::isspace(static_cast<unsigned char>(line.next()))) asked = true;
  if (asked) first = line.spaces().name();
  rest = line.fields();
  if (first.empty()) return "";
  if (!asked) {
    if (!line.spaces().take("?")) return "";
    source = line.take("?");
  }
  if (!line.ended()) return "";
  if (!is_variable(first)) return "help \"" + first + rest + "\"";
  for (char& c : rest) c = c == ':' ? '.' : c;
  return (source ? "source(" : "help(") + first + rest + ")";
}

std::deque<std::string> lines_of(const std::string& text) {
  std::deque<std::string> lines;
  std::size_t from = 0;
  for (auto end = text.find('\n'); end != std::string::npos; end = text.find('\n', from)) {
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  if (from < text.size() || lines.empty()) lines.push_back(text.substr(from));
  return lines;
}

bool goes_on_with(const std::string& text) {
  InputReader line(text);
  const char c = line.spaces().next();
  if (c == ':') return line.next(1) != '\0' && line.next(1) != ':';
  if (c != '\0' && std::string(".+*/%^,=<>~)}]").find(c) != std::string::npos) return true;
  const std::string word = line.name();
  return word == "and" || word == "or";
}

}  // namespace dotyk::script

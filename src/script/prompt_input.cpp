#include "script/prompt_input.hpp"

#include <regex>

namespace dotyk::script {

bool wants_out(const std::string& input) {
  static const std::regex leaving(R"(\s*(exit|quit)\s*(\(\s*\))?\s*;?\s*)");
  return std::regex_match(input, leaving);
}

std::string question(const std::string& input, const std::function<bool(const std::string&)>& is_variable) {
  static const std::string names = R"(([A-Za-z_]\w*)((?:[.:][A-Za-z_]\w*)*))";
  static const std::regex before(R"(\s*(?:\?|help\s+))" + names + R"(\s*)");
  static const std::regex after(R"(\s*)" + names + R"(\s*(\?\??)\s*)");
  std::smatch found;
  const bool asks = std::regex_match(input, found, before) || std::regex_match(input, found, after);
  if (!asks) return "";
  std::string first = found[1], rest = found[2];
  if (!is_variable(first)) return "help \"" + first + rest + "\"";
  for (char& c : rest) c = c == ':' ? '.' : c;
  const bool source = found.size() > 3 && found[3] == "??";
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

bool goes_on_with(const std::string& line) {
  static const std::regex beginning(R"(\s*(:[^:]|\.|[+*/%^,=<>~)}\]]|(and|or)\b).*)");
  return std::regex_match(line, beginning);
}

}  // namespace dotyk::script

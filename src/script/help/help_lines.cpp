#include "script/help/help_lines.hpp"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "script/prompt/terminal.hpp"

namespace dotyk::script {
namespace {

constexpr std::size_t name_column = 31;  // where sentences begin

std::string first_sentence(const std::string& text) {
  const auto end = text.find(". ");
  auto sentence = end == std::string::npos ? text : text.substr(0, end);
  if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
  return sentence;
}

// Of a sentence too long as many clauses as fit; where none does, as many words.
std::string clause(const std::string& sentence, std::size_t room) {
  std::size_t last = 0, word = 0, depth = 0;
  for (std::size_t at = 0; at + 1 < sentence.size() && letters(sentence.substr(0, at)) <= room; ++at) {
    const char c = sentence[at];
    const bool ends = sentence[at + 1] == ' ' && (c == ',' || c == ';' || c == ':');
    if (depth == 0 && (ends || (c == ' ' && sentence[at + 1] == '('))) last = at;
    if (c == ' ' && letters(sentence.substr(0, at)) + 2 <= room) word = at;
    depth += c == '(' ? 1 : c == ')' && depth > 0 ? -1 : 0;
  }
  return last > 0 ? sentence.substr(0, last) : sentence.substr(0, word) + " …";
}

std::string name_part(const std::string& name) {
  return padded("  " + name + " ", name_column);
}

}  // namespace

std::size_t line_width(std::size_t more) {
  const std::size_t pleasant = 96 + more, least = 40;
  const std::size_t width = terminal_size(STDOUT_FILENO).ws_col;
  return width > 0 ? std::clamp(width - 1, least, pleasant) : pleasant;
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t count) { return text + std::string(count - std::min(letters(text), count), ' '); }

std::string wrapped(const std::string& text, const std::string& start, const std::string& indent) {
  const std::size_t width = line_width();
  std::istringstream words(text);
  std::string word, all, line = start;
  bool empty = true;
  while (words >> word) {
    if (!empty && letters(line) + 1 + letters(word) > width) {
      all += line + "\n";
      line = indent;
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return empty && start == indent ? all : all + line + "\n";
}

std::string wrapped(const std::string& text, const std::string& indent) { return wrapped(text, indent, indent); }

std::string summary_line(const std::string& name, const std::string& help) {
  return wrapped(first_sentence(help), name_part(name), std::string(name_column, ' '));
}

std::string short_line(const std::string& name, const std::string& help) {
  const auto start = name_part(name), sentence = first_sentence(help);
  constexpr std::size_t more = 4;  // where the terminal has them: what is one line is easier to look through
  const auto width = line_width(more);
  const auto room = std::max<std::size_t>(width - std::min(width, letters(start)), 20);
  return start + (letters(sentence) <= room ? sentence : clause(sentence, room)) + "\n";
}

}  // namespace dotyk::script

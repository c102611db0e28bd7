#include "script/help/help.hpp"

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

// "name = value" stays together.
std::string wrapped_signature(std::string text) {
  constexpr char held = '\x1f';
  for (std::size_t at; (at = text.find(" = ")) != std::string::npos;) text[at] = text[at + 2] = held;
  text = wrapped(text, "", "    ");
  std::replace(text.begin(), text.end(), held, ' ');
  return text;
}

std::string facts(const Key& key) {
  auto text = key.expected();
  if (!key.units.empty()) text += ", " + key.units;
  if (key.needed || key.name.empty()) return text;  // of an item the list says whether it is needed
  return text + (key.default_text.empty() ? "; optional" : "; default " + key.default_text);
}

void list_key(std::string& out, const Key& key, const std::string& indent) {
  constexpr std::size_t column = 16;
  const auto name = padded((key.name.empty() ? "…" : key.name) + " ", column);
  const auto further = indent + std::string(column, ' ');
  out += wrapped(key.help, indent + name, further) + wrapped("(" + facts(key) + ")", further);
  for (const auto& inner : inner_keys(key)) list_key(out, inner, indent + "    ");
}

std::string indented(const std::string& text, const std::string& indent) {
  std::istringstream lines(text);
  std::string line, all;
  while (std::getline(lines, line)) all += indent + line + "\n";
  return all;
}

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

void add_rows(std::string& out, const std::vector<Key>& keys, const std::string& prefix) {
  for (const auto& key : keys) {
    const auto name = prefix + (key.name.empty() ? "…" : key.name);
    const auto absent = key.needed                 ? std::string("required")
                        : key.default_text.empty() ? std::string("–")
                                                   : "`" + key.default_text + "`";
    out += "| `" + name + "` | " + cell(key.expected()) + " | " + cell(key.units) + " | " + absent + " | " +
           cell(key.help) + " |\n";
    add_rows(out, named_keys(key), name + ".");
    for (const auto& item : key.items) add_rows(out, named_keys(item), name + "[i].");
  }
}

std::string entry(const Descriptor& one) {
  auto out = "### `" + one.signature() + "`\n\n" + one.help +
             (one.returns.empty() ? "" : " Returns: " + one.returns + ".") + "\n\n";
  if (const auto keys = one.keys(); !keys.empty()) {
    out += "| name | kind | unit | default | |\n|---|---|---|---|---|\n";
    add_rows(out, keys, "");
    out += "\n";
  }
  return one.example.empty() ? out : out + "```lua\n" + one.whole_example() + "\n```\n\n";
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

std::string help_text(const Descriptor& descriptor) {
  auto out = wrapped_signature(descriptor.signature() + (descriptor.returns.empty() ? "" : " → " + descriptor.returns));
  out += wrapped(descriptor.help, "  ");
  if (!descriptor.arguments.empty()) out += "\n";
  for (const auto& key : descriptor.keys()) list_key(out, key, "  ");
  if (!descriptor.example.empty()) out += "\n  Example:\n" + indented(descriptor.whole_example(), "    ");
  return out;
}

std::string help_text(const Library& library, const Type& type) {
  auto out = type.name + "\n" + wrapped(type.help, "  ");
  if (!type.fields.empty()) out += "\n  Fields:\n";
  for (const auto& field : type.fields) {
    out +=
        "  " + summary_line(field.name, field.help + (field.units.empty() ? "" : " [" + field.units + "]"));
  }
  if (!type.methods.empty()) out += "\n  Methods:\n";
  for (const auto& method : type.methods) out += "  " + summary_line(method.name, method.help);
  std::string makers;
  for (const auto& one : library.functions())
    if (one.returns == type.name) makers += (makers.empty() ? "" : ", ") + one.name;
  return makers.empty() ? out : out + "\n  Made by " + makers + ".\n";
}

std::string help_text(const Library& library, const Module& module) {
  auto out = module.name + "\n" + wrapped(module.help, "  ") + "\n";
  for (const auto& one : library.functions()) {
    const auto dot = one.name.rfind('.');
    if (dot != std::string::npos && one.name.substr(0, dot) == module.name)
      out += summary_line(one.name, one.help);
  }
  for (const auto& inner : library.modules())
    if (inner.name.rfind(module.name + ".", 0) == 0) out += summary_line(inner.name, inner.help);
  return out;
}

std::string reference_page(const Library& library) {
  std::string out =
      "# dotyk: reference\n\nWritten by dotyk itself, from the descriptions that `help()` shows.\n\n## "
      "Functions\n\n";
  for (const auto& one : library.functions()) out += entry(one);
  out += "## Objects\n\n";
  for (const auto& type : library.types()) {
    out += "### " + type.name + "\n\n" + type.help + "\n\n";
    if (!type.fields.empty()) out += "| field | unit | |\n|---|---|---|\n";
    for (const auto& field : type.fields)
      out += "| `" + field.name + "` | " + cell(field.units) + " | " + cell(field.help) + " |\n";
    if (!type.fields.empty()) out += "\n";
    for (const auto& method : type.methods) out += entry(method);
  }
  return out;
}

}  // namespace dotyk::script

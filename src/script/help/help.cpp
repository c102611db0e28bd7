#include "script/help/help.hpp"

#include <algorithm>
#include <sstream>

#include "script/help/help_lines.hpp"

namespace dotyk::script {
namespace {

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
  for (const auto& one : library.functions()) {
    if (one.returns == type.name) makers += (makers.empty() ? "" : ", ") + one.name;
  }
  return makers.empty() ? out : out + "\n  Made by " + makers + ".\n";
}

std::string help_text(const Library& library, const Module& module) {
  auto out = module.name + "\n" + wrapped(module.help, "  ") + "\n";
  for (const auto& one : library.functions()) {
    const auto dot = one.name.rfind('.');
    if (dot != std::string::npos && one.name.substr(0, dot) == module.name)
      out += summary_line(one.name, one.help);
  }
  for (const auto& inner : library.modules()) {
    if (inner.name.rfind(module.name + ".", 0) == 0) out += summary_line(inner.name, inner.help);
  }
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

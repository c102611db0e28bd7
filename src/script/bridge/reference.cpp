// The reference page: the same descriptions as help(), as Markdown.
#include "script/help/help.hpp"

namespace dotyk::script {
namespace {

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
  auto keys = one.arguments;
  if (one.takes_table()) {
    keys = one.arguments[0].items;
    keys.insert(keys.end(), one.arguments[0].keys.begin(), one.arguments[0].keys.end());
  }
  if (!keys.empty()) {
    out += "| name | kind | unit | default | |\n|---|---|---|---|---|\n";
    add_rows(out, keys, "");
    out += "\n";
  }
  return one.example.empty() ? out : out + "```lua\n" + one.whole_example() + "\n```\n\n";
}

}  // namespace

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

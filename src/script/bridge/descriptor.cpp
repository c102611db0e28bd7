#include "script/bridge/descriptor.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "script/help/nearest.hpp"

namespace dotyk::script {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";  // printf would tell its sign
  char text[40];
  for (int digits : {6, 15, 17}) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

std::string plural(const std::string& noun) {
  return noun.ends_with("dy") ? noun.substr(0, noun.size() - 1) + "ies" : noun + "s";
}

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + (count == 1 ? noun : plural(noun));
}

std::string with_article(const std::string& noun) {
  const bool vowel = !noun.empty() && std::string("aeiou").find(noun[0]) != std::string::npos;
  return (vowel ? "an " : "a ") + noun;
}

Key& Key::fallback(double value) { return set(default_value, value).otherwise(number_text(value)); }
Key& Key::fallback(bool value) { return set(default_value, value).otherwise(value ? "true" : "false"); }
Key& Key::fallback(const char* value) { return set(default_value, std::string(value)).otherwise("\"" + std::string(value) + "\""); }
Key& Key::choice_fallback(int value) { return fallback(choices.at(std::find(values.begin(), values.end(), value) - values.begin()).c_str()); }

namespace {

std::string count_text(const Key& key, const std::string& noun) {
  const bool bounded = key.most != std::numeric_limits<std::size_t>::max();
  if (key.fewest == key.most) return counted(key.fewest, noun);
  if (bounded) return std::to_string(key.fewest) + (key.fewest + 1 == key.most ? " or " : " to ") + counted(key.most, noun);
  if (key.fewest > 0) return "at least " + counted(key.fewest, noun);
  return plural(noun);
}

std::string range_text(const Key& key) {
  const bool low = std::isfinite(key.least), high = std::isfinite(key.greatest);
  const std::string least = number_text(key.least), greatest = number_text(key.greatest);
  if (low && high && !key.least_excluded && !key.greatest_excluded) return " from " + least + " to " + greatest;
  const std::string above = !low ? "" : (key.least_excluded ? " above " : " of at least ") + least;
  const std::string below = !high ? "" : (key.greatest_excluded ? " below " : " of at most ") + greatest;
  return above + (low && high ? " and" : "") + below + (key.infinite ? " (math.huge too)" : "");
}

}  // namespace

std::string Key::expected() const {
  static const std::map<Kind, std::string> plain = {
      {Kind::boolean, "true or false"}, {Kind::string, "a string"}, {Kind::file, "a string"}, {Kind::function, "a function"}, {Kind::table, "a table"},
      {Kind::matrix, "a table of rows, each a table of numbers"}, {Kind::any, "a value"},
      {Kind::field, "a number, a table of numbers or a function of the coordinates"}};
  if (const auto found = plain.find(kind); found != plain.end()) return found->second;
  if (kind == Kind::number || kind == Kind::integer) {
    const std::string noun = kind == Kind::number ? "number" : "integer";
    const bool is_positive = least == 0 && least_excluded && std::isinf(greatest);
    return is_positive ? "a positive " + noun : with_article(noun) + range_text(*this);
  }
  if (kind == Kind::choice) return join(choices, "or", "\"");
  if (kind == Kind::vector) return "a table of " + count_text(*this, "number");
  if (kind == Kind::object) return with_article(type);
  if (kind == Kind::list) {
    const auto& item = items.front();
    if (item.kind == Kind::object) return "a table of " + count_text(*this, item.type);
    if (item.kind == Kind::integer) return "a table of " + count_text(*this, "integer");
    return "a table of " + count_text(*this, "item") + ", each " + item.expected();
  }
  std::vector<std::string> kinds;  // of an either
  for (const auto& one : keys) kinds.push_back(one.expected());
  return join(kinds, "or", "");
}

std::vector<Key> joined(std::vector<Key> these, const std::vector<Key>& those) {
  these.insert(these.end(), those.begin(), those.end());
  return these;
}

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.name);
  return names;
}

std::vector<Key> named_keys(const Key& key) {
  if (key.kind == Kind::table) return key.keys;
  std::vector<Key> all;
  for (std::size_t i = 0; key.kind == Kind::either && i < key.keys.size(); ++i) all = joined(std::move(all), named_keys(key.keys[i]));
  return all;
}

std::vector<Key> inner_keys(const Key& key) {
  auto all = named_keys(key);
  for (const auto& item : key.items) all = joined(std::move(all), named_keys(item));
  return all;
}

std::string Descriptor::short_name() const {
  const auto at = name.find_last_of(".:");
  return at == std::string::npos ? name : name.substr(at + 1);
}

std::string Descriptor::owner() const {
  const auto at = name.find(':');
  return at == std::string::npos ? "" : name.substr(0, at);
}

bool Descriptor::takes_table() const {
  return arguments.size() == 1 && arguments[0].kind == Kind::table && arguments[0].name.empty();
}

std::vector<Key> Descriptor::keys() const { return takes_table() ? joined(arguments[0].items, arguments[0].keys) : arguments; }

std::string Descriptor::whole_example() const {
  return setup.empty() || setup.back() == '\n' ? setup + example : setup + "\n" + example;
}

std::string Descriptor::signature() const {
  std::string text;
  const auto add = [&text](const Key& key) {
    if (!text.empty()) text += ", ";
    text += key.name.empty() ? "…" : key.name;
    if (!std::holds_alternative<std::monostate>(key.default_value)) text += " = " + key.default_text;
  };
  if (takes_table()) {
    for (const auto& item : arguments[0].items)
      text += item.name.empty() ? item.type + ", …" : item.name + ", …";
    for (const auto& key : arguments[0].keys) add(key);
    return name + "{ " + text + " }";
  }
  for (const auto& argument : arguments) {
    if (argument.needed) {
      add(argument);
    } else {
      text += (text.empty() ? "[" : "[, ") + argument.name + "]";
    }
  }
  return name + "(" + text + ")";
}

namespace key {
Key positive(std::string name, std::string help) { return number(std::move(name), std::move(help)).above(0); }
Key choice(std::string name, std::vector<std::string> choices, std::string help) {
  auto key = plain<Kind::choice>(std::move(name), std::move(help));
  key.choices = std::move(choices);
  return key;
}
Key list(std::string name, Key item, std::string help) {
  return plain<Kind::list>(std::move(name), std::move(help)).with(std::move(item));
}
Key table(std::string name, std::vector<Key> keys, std::string help) {
  auto key = plain<Kind::table>(std::move(name), std::move(help));
  key.keys = std::move(keys);
  return key;
}
Key table(std::vector<Key> keys) { return table("", std::move(keys), "").required(); }
Key either(std::string name, std::vector<Key> kinds, std::string help) {
  auto key = plain<Kind::either>(std::move(name), std::move(help));
  key.keys = std::move(kinds);
  return key;
}
}  // namespace key

}  // namespace dotyk::script

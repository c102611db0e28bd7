// Help on a word: all names and texts that hold it.
#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

#include "script/help/help.hpp"

namespace dotyk::script {
namespace {

enum class Fit { name, part_of_name, text };

struct Hit {
  Fit fit;
  std::string name, line;
  std::function<std::string()> page;  // empty: of a key or a field, which has none of its own
};

// Lower case, with blanks between the words of a name.
std::string plain(std::string text) {
  for (char& c : text) c = c == '_' || c == '-' || c == '.' || c == ':' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Where a word of the text begins so; npos: nowhere.
std::size_t begins_in(const std::string& text, const std::string& wanted) {
  std::size_t at = text.find(wanted);
  while (at != std::string::npos && at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1]))) at = text.find(wanted, at + 1);
  return at;
}

// From the clause with the word on.
std::string excerpt(const std::string& help, std::size_t at) {
  std::size_t start = 0;
  for (const char* end : {". ", "; ", ", ", ": "}) {
    const auto before = help.rfind(end, at);
    if (before != std::string::npos && before < at) start = std::max(start, before + 2);
  }
  return (start > 0 ? "… " : "") + help.substr(start);
}

class Search {
 public:
  Search(const Library& library, const std::string& word) : library_(library), wanted_(plain(word)) {
    for (const auto& one : library.functions()) look(one);
    for (const auto& type : library.types()) {
      look(type.name, type.name, type.help, [&] { return help_text(library_, type); });
      for (const auto& field : type.fields) look(type.name + "." + field.name, field.name, field.help, {});
      for (const auto& method : type.methods) look(method);
    }
    for (const auto& one : library.modules())
      look(one.name, one.name.substr(one.name.rfind('.') + 1), one.help, [&] { return help_text(library_, one); });
    std::stable_sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return std::pair(a.fit, !a.page) < std::pair(b.fit, !b.page); });
  }

  std::string text() const {
    const auto named = [](const Hit& hit) { return hit.fit == Fit::name && hit.page; };
    if (hits_.size() == 1 && hits_[0].page) return hits_[0].page();
    if (std::count_if(hits_.begin(), hits_.end(), named) != 1) return lines(nullptr);
    const Hit& page = *std::find_if(hits_.begin(), hits_.end(), named);
    return page.page() + "\nThe word is also in:\n" + lines(&page);
  }

 private:
  void look(const Descriptor& one) {
    look(one.name, one.short_name(), one.help, [&] { return help_text(one); });
    for (const auto& argument : one.arguments) look_in(one.name, argument, one.takes_table());
  }

  // The keys of tables have names that scripts write; arguments in order are of interest for their texts.
  void look_in(const std::string& owner, const Key& key, bool open) {
    for (const auto& inner : named_keys(key)) {
      look(owner + "{ " + inner.name + " }", inner.name, inner.help + " (" + inner.expected() + ")", {});
      look_in(owner, inner, true);
    }
    for (const auto& item : key.items) look_in(owner, item, true);
    if (!open) look(owner + "(" + key.name + ")", "", key.help + " (" + key.expected() + ")", {});
  }

  void look(const std::string& name, const std::string& short_name, const std::string& help, std::function<std::string()> page) {
    const auto add = [&](Fit fit, const std::string& shown) { hits_.push_back({fit, name, short_line(name, shown), std::move(page)}); };
    if (plain(short_name) == wanted_) return add(Fit::name, help);
    if (!short_name.empty() && begins_in(plain(short_name), wanted_) != std::string::npos) return add(Fit::part_of_name, help);
    const auto at = begins_in(plain(help), wanted_);
    if (at != std::string::npos) add(Fit::text, excerpt(help, at));
  }

  std::string lines(const Hit* without) const {
    std::string out;
    for (const auto& hit : hits_)
      if (&hit != without) out += hit.line;
    return out;
  }

  const Library& library_;
  std::string wanted_;
  std::vector<Hit> hits_;
};

}  // namespace

std::string help_search(const Library& library, const std::string& word) {
  const bool letters = std::any_of(word.begin(), word.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) != 0; });
  return letters ? Search(library, word).text() : "";
}

}  // namespace dotyk::script

// What help() lists, by what it is for, and what there is to know of the prompt. Help on a word: all names and texts that hold it.
#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <utility>

#include "script/help/help.hpp"

namespace dotyk::script {
namespace {

// Names, those that begin so (ending in a dot), and objects.
struct Group {
  const char* title;
  std::vector<std::string> names, objects;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"Scenes and bodies", {"dotyk.material", "dotyk.body", "dotyk.scene"}, {"material", "body", "part", "scene"}},
      {"Meshes", {"dotyk.mesh.", "dotyk.refinement", "dotyk.adapt"}, {"mesh", "refinement"}},
      {"Contact and friction", {"dotyk.rigid.", "dotyk.friction."}, {"contact", "rigid"}},
      {"Solvers", {"dotyk.solve", "dotyk.solver.", "dotyk.all_solutions", "dotyk.work_precision"}, {"solver"}},
      {"Solutions and pictures", {"dotyk.chart"}, {"solution"}},
      {"Beams, plates, channels, and laws of supports",
       {"dotyk.beam", "dotyk.thermoelastic_beam", "dotyk.plate", "dotyk.channel", "dotyk.law.", "dotyk.support_gallery"},
       {"law", "beam", "beam_solution", "thermoelastic_beam", "plate", "plate_solution", "channel", "channel_stepping"}},
      {"Shapes and sensitivities", {"dotyk.shape", "dotyk.repeated_systems", "dotyk.dual."}, {"shape", "design", "optimum", "repeated_systems"}},
      {"Programs and problems from files", {"dotyk.qp", "dotyk.lcp", "dotyk.fclib"},
       {"program", "program_result", "lcp_result", "contact_problem", "contact_problem_result"}},
  };
  return all;
}

bool is_in(const std::string& name, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& one) { return one.back() == '.' ? name.rfind(one, 0) == 0 : name == one; });
}

// Functions of numbers in one line.
constexpr char of_numbers[] = "dotyk.dual.";

std::string listed(const std::vector<const Descriptor*>& functions, const std::vector<std::string>& objects) {
  std::string out, numbers;
  for (const auto* one : functions) {
    if (one->name.rfind(of_numbers, 0) == 0) numbers += (numbers.empty() ? "" : ", ") + one->short_name();
    else out += short_line(one->name, one->help);
  }
  if (!numbers.empty()) out += short_line(std::string(of_numbers) + "…", "of dual numbers: " + numbers);
  std::string names;
  for (const auto& name : objects) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? out : out + wrapped(names, "  objects: ", "           ");
}

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

std::string help_index(const Library& library) {
  std::string out = "The model: linear elasticity at rest, for small strains and rotations (a few per cent; a solution\n"
                    "warns where they are greater), contact of what faces each other before the load.\n\n";
  std::vector<const Descriptor*> rest;
  for (const auto& one : library.functions()) rest.push_back(&one);
  std::vector<std::string> objects;
  for (const auto& type : library.types()) objects.push_back(type.name);
  for (const auto& group : groups()) {
    const auto of_group = std::stable_partition(rest.begin(), rest.end(), [&](const Descriptor* one) { return !is_in(one->name, group.names); });
    std::vector<const Descriptor*> functions(of_group, rest.end());
    rest.erase(of_group, rest.end());
    const auto place = [&](const Descriptor* one) {
      return std::find_if(group.names.begin(), group.names.end(), [&](const std::string& name) { return is_in(one->name, {name}); });
    };
    std::stable_sort(functions.begin(), functions.end(), [&](const Descriptor* a, const Descriptor* b) { return place(a) < place(b); });
    std::erase_if(objects, [&](const std::string& name) { return is_in(name, group.objects); });
    out += std::string(group.title) + ":\n" + listed(functions, group.objects) + "\n";
  }
  return out + "The rest:\n" + listed(rest, objects) + "\n" + help_on_prompt();
}

std::string help_on_prompt() {
  const std::array<std::pair<const char*, const char*>, 9> lines{{
      {"help(x), x?", "on a function, an object, a method (body:part?), a name or a word (help \"force\")"},
      {"source(f), f??", "the text of a function written in Lua, one typed here included"},
      {"Tab", "completes names, methods, keys, what a key may be, boundary parts, files"},
      {"_", "the last result; 5, 6 and return 5, 6 leave the first"},
      {"%time EXPRESSION", "evaluates it, and says how long that took"},
      {"local x = …", "stays for the next inputs, so that lines of scripts can be pasted"},
      {"up, Ctrl-R", "earlier inputs that begin with what is typed; those that hold it"},
      {"Ctrl-C, Ctrl-D", "stops a loop, or a solve, which gives its state so far; leaves, as exit"},
      {"dotyk.reference()", "all of help as Markdown (dotyk -e 'print(dotyk.reference())' > help.md)"},
  }};
  std::string out = "At the prompt:\n";
  for (const auto& [what, does] : lines) out += wrapped(does, padded("  " + std::string(what), 22), std::string(22, ' '));
  return out;
}

std::string help_search(const Library& library, const std::string& word) {
  const bool letters = std::any_of(word.begin(), word.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || (c & 0x80) != 0; });
  return letters ? Search(library, word).text() : "";
}

}  // namespace dotyk::script

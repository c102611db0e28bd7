// What help() lists, by what it is for, and what there is to know of the prompt.
#include <algorithm>
#include <array>
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
      {"Contact and friction", {"dotyk.rigid.", "dotyk.friction."}, {"contact", "rigid", "friction"}},
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

}  // namespace

std::string help_index(const Library& library) {
  std::string out;
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

}  // namespace dotyk::script

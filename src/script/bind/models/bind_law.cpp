#include "script/bind/bind.hpp"
#include "script/bind/models/models.hpp"

namespace dotyk::script {
namespace {

using problem::SupportLaw;
using Kind = SupportLaw::Kind;

struct Maker {
  const char* name;
  Kind kind;
  const char* help;
  std::vector<Key> numbers;
  double SupportLaw::*second = &SupportLaw::limit;  // the first is the value
  bool by_name = false;  // in a table
};

Key stiffness(const char* name = "k", const char* help = "stiffness, not negative") {
  return key::number(name, help).unit("force/length, or moment of a rotation; on a part per length or area as well").at_least(0).required();
}
Key bound() { return key::number("g", "greatest force, not negative").unit("force, or moment of a rotation; on a part per length or area").at_least(0).required(); }

std::vector<Maker> makers() {
  return {{"free", Kind::free, "A support that does nothing.", {}},
          {"prescribed", Kind::prescribed, "Prescribes the displacement.",
           {key::number("v", "the deflection, rotation or displacement").unit("length, or rad").fallback(0.0)}},
          {"load", Kind::load, "A load: a force, a moment on the rotation, or a pressure on a part.",
           {key::number("f", "up, a moment anticlockwise; of a part into the body, a pressure").unit("force, or moment; on a part per length or area").required()}},
          {"elastic", Kind::elastic, "A spring: the reaction is -k v.", {stiffness()}},
          {"one_sided_elastic", Kind::one_sided_elastic,
           "A spring that only pushes: up against deflections below zero, down against slopes above zero, off the support on a part.", {stiffness()}},
          {"signorini", Kind::signorini, "A rigid stop: the deflection stays at or above zero, a slope at or below zero, a part does not enter the support.", {}},
          {"friction", Kind::friction, "Rigid friction: holds up to a reaction of g, and slips against it.", {bound()}},
          {"one_sided_friction", Kind::one_sided_friction, "Rigid friction on one side: holds up to g where a rigid stop would push, and else not at all.", {bound()}},
          {"capped_elastic", Kind::capped_elastic, "A spring whose reaction is at most g, either way.", {stiffness(), bound()}},
          {"unequal_elastic", Kind::unequal_elastic,
           "A spring that pushes with one stiffness and pulls with another: the reaction is -k_push v or -k_pull v. It pushes where one_sided_elastic does: "
           "up against deflections below zero, down against slopes above zero, off the support on a part.",
           {stiffness("k_push", "stiffness where it pushes, not negative"), stiffness("k_pull", "stiffness where it pulls, not negative")}, &SupportLaw::pull},
          {"compliance", Kind::compliance,
           "Asperities that are pressed flat: pushes with c (-v)^m against v < 0, and not at all otherwise.",
           {key::number("c", "factor, not negative").unit("force/length^m; on a part per length or area as well").at_least(0).required(),
            key::number("m", "power").at_least(1).fallback(2.0)},
           &SupportLaw::power, true},
          {"breaking", Kind::breaking,
           "A spring that only pushes and breaks where its reaction would exceed g. Not monotone: a beam may have several solutions (s.branches), of a part one path is followed.",
           {stiffness(), bound()}}};
}

const char* example_of(const std::string& number) {
  if (number == "k" || number == "k_push" || number == "c") return "100";
  if (number == "m") return "2";
  if (number == "k_pull") return "20";
  return number == "g" ? "2" : "-1";
}

std::string law_text(const SupportLaw& law) { return "law: " + problem::describe(law); }

}  // namespace

void bind_law(Library& library) {
  library.module("dotyk.law", "What a support does about one displacement: a beam's deflection or rotation, or along the normal or tangents of a part (part:support), or of two that touch (scene:contact).");
  for (const Maker& e : makers()) {
    const std::string name = std::string("dotyk.law.") + e.name;
    std::string example;
    for (const Key& number : e.numbers) example += (example.empty() ? "" : ", ") + (e.by_name ? number.name + " = " : "") + example_of(number.name);
    example = e.by_name ? "{ " + example + " }" : "(" + example + ")";
    const auto make = [kind = e.kind, numbers = e.numbers, second = e.second](Call& call) {
      auto law = std::make_shared<SupportLaw>();
      law->kind = kind;
      if (!numbers.empty()) law->value = call.number(numbers[0].name);
      if (numbers.size() > 1) (*law).*second = call.number(numbers[1].name);
      return law;
    };
    library.function({.name = name, .help = e.help, .example = "local law = " + name + example, .arguments = e.by_name ? std::vector<Key>{key::table(e.numbers)} : e.numbers, .run = make});
  }
  library.type<SupportLaw>("What a support does about one displacement.").text(law_text);
}

}  // namespace dotyk::script

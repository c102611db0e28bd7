#include "script/bind/bind.hpp"
#include "script/bind/models/models.hpp"

namespace dotyk::script {
namespace {

using problem::LawChoice;
using problem::LawNumber;
using problem::LawSpec;

Key key_of(const LawNumber& number) {
  Key key = key::number(number.name, number.help);
  if (*number.unit) key = key.unit(number.unit);
  if (std::isfinite(number.least)) key = key.at_least(number.least);
  return number.usual ? key.fallback(*number.usual) : key.required();
}

}  // namespace

void bind_law(Library& library) {
  library.module("dotyk.law", "What a support does about one displacement: a beam's deflection or rotation, or along the normal or tangents of a part (part:support), or of two that touch (scene:contact).");
  for (const LawSpec* spec : problem::law_table()) {
    if (spec->traits.follows) continue;  // dotyk.friction.coulomb
    const std::string name = std::string("dotyk.law.") + spec->name;
    std::vector<Key> keys;
    std::string example;
    for (int i = 0; i < spec->count(); ++i) {
      const LawNumber& number = spec->numbers[i];
      keys.push_back(key_of(number));
      example += (i > 0 ? ", " : "") + (spec->named ? std::string(number.name) + " = " : "") + number.example;
    }
    example = spec->named ? "{ " + example + " }" : "(" + example + ")";
    const auto make = [spec](Call& call) {
      auto law = std::make_shared<LawChoice>(LawChoice{spec});
      for (int i = 0; i < spec->count(); ++i) law->numbers[i] = call.number(spec->numbers[i].name);
      return law;
    };
    library.function({.name = name, .help = spec->help, .example = "local law = " + name + example, .arguments = spec->named ? std::vector<Key>{key::table(keys)} : keys, .run = make});
  }
  library.type<LawChoice>("What a support does about one displacement.").text([](const LawChoice& law) { return "law: " + problem::describe(law); });
}

}  // namespace dotyk::script

#include <cmath>

#include "script/bind/bind.hpp"
#include "script/bind/models/models.hpp"

namespace dotyk::script {
namespace {

using problem::LawChoice;
using problem::LawNumber;
using problem::LawSpec;

bool of_functions(const LawChoice& law) {
  return std::any_of(law.numbers.begin(), law.numbers.end(), [](double n) { return std::isnan(n); });
}

LawChoice without_normal(const LawChoice& law, const char* name) {
  if (law->follows) throw InputError(text("'", name, "': Coulomb friction follows a normal force, and none is here; give dotyk.law.friction"));
  return law;
}

}  // namespace

Key law_key(const char* name, const char* help) { return key::object<LawChoice>(name, help).otherwise("free"); }

LawChoice law(const Arguments& from, const char* name) {
  if (!from.has(name)) return {};
  const LawChoice law = *from.object<LawChoice>(name);
  if (of_functions(law)) throw InputError(text("'", name, "': a number of this law is a function of the place; at a point give a number"));
  return without_normal(law, name);
}

Key law_field_key(const char* name, const char* help) {
  return key::either(name, {key::object<LawChoice>("", "a law of dotyk.law"), key::function("", "f(x, …) → a law")}, help).otherwise("free");
}

LawOfPlace law_field(const Arguments& from, const char* name) {
  if (!from.has(name)) return nullptr;
  if (from.is(name, LUA_TFUNCTION)) {
    const Function function = from.function(name);
    return [function, name](std::span<const double> x) {
      const LawChoice law = *function.object<LawChoice>(x);
      if (of_functions(law)) throw InputError(text("'", name, "': a function that gives laws gives them with numbers, and this is ", problem::describe(law)));
      return law;
    };
  }
  const LawChoice law = *from.object<LawChoice>(name);
  std::vector<std::pair<int, Function>> functions;
  for (int i = 0; i < law.spec->count(); ++i)
    if (std::isnan(law.numbers[i])) functions.emplace_back(i, from.kept_function(from.slot(name), law.spec->numbers[i].name).at(0));
  return [law, functions](std::span<const double> x) {
    LawChoice here = law;
    for (const auto& [i, function] : functions) function.numbers(x, {&here.numbers[i], 1}, law->rubs());
    return here;
  };
}

LawOfPlace law_field_without_normal(const Arguments& from, const char* name) {
  LawOfPlace law = law_field(from, name);
  if (!law) return nullptr;
  return [law, name](std::span<const double> x) { return without_normal(law(x), name); };
}

std::vector<Key> law_number_keys(const LawSpec& spec) {
  std::vector<Key> keys;
  for (int i = 0; i < spec.count(); ++i) {
    const LawNumber& number = spec.numbers[i];
    Key key = key::number("", "");
    if (std::isfinite(number.least)) key = key.at_least(number.least);
    if (spec.traits.rubs() && number.role == LawNumber::Role::bound) key = key.or_infinite();
    key = key::either(number.name, {key, key::function("", "")}, number.help);
    if (*number.unit) key = key.unit(number.unit);
    keys.push_back(number.usual ? key.fallback(*number.usual) : key.required());
  }
  return keys;
}

Given<LawChoice> make_law(Call& call, const LawSpec& spec) {
  auto law = std::make_shared<LawChoice>(LawChoice{&spec});
  for (int i = 0; i < spec.count(); ++i) law->numbers[i] = call.is(spec.numbers[i].name, LUA_TFUNCTION) ? NAN : call.number(spec.numbers[i].name);
  const auto given = call.give_keeping(law, {});
  const int index = lua_gettop(call.state());
  for (int i = 0; i < spec.count(); ++i)
    if (std::isnan(law->numbers[i])) call.keep(index, spec.numbers[i].name, call.slot(spec.numbers[i].name));
  return given;
}

void bind_law(Library& library) {
  library.module("dotyk.law", "What a support does about one displacement: a beam's deflection or rotation, or along the normal or tangents of a part (part:support), or of two that touch (scene:contact). "
                 "Along a part a number may be a function of the coordinates.");
  for (const LawSpec* spec : problem::law_table()) {
    if (spec->traits.follows) continue;  // dotyk.friction.coulomb
    const std::string name = std::string("dotyk.law.") + spec->name;
    std::string example;
    for (int i = 0; i < spec->count(); ++i) example += (i > 0 ? ", " : "") + (spec->named ? std::string(spec->numbers[i].name) + " = " : "") + spec->numbers[i].example;
    example = spec->named ? "{ " + example + " }" : "(" + example + ")";
    const std::vector<Key> keys = law_number_keys(*spec);
    library.function({.name = name, .help = spec->help, .example = "local law = " + name + example, .arguments = spec->named ? std::vector<Key>{key::table(keys)} : keys,
                      .run = [spec](Call& call) { return make_law(call, *spec); }});
  }
  library.type<LawChoice>("What a support does about one displacement.").text([](const LawChoice& law) { return "law: " + problem::describe(law); });
}

}  // namespace dotyk::script

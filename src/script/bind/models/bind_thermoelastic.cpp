#include "script/bind/models/models.hpp"

#include "script/bind/bind.hpp"

namespace dotyk::script {
namespace {

using thermoelastic::Data;
using thermoelastic::History;
using thermoelastic::Loads;
using thermoelastic::Scheme;
using thermoelastic::Source;
using thermoelastic::Stepping;

const std::array<const char*, 2> kEnds{"left", "right"};

// Where a function is kept: "load", "ambient.above", "left.temperature", "supports[1].force".
struct LoadPlace {
  std::string table, name;
  int item = -1;  // of a list
  std::string kept() const { return (table.empty() ? "" : item < 0 ? table + "." : text(table, "[", item + 1, "].")) + name; }
};

// Every load, with where a script says it.
template <class Use>
void each_load(Loads& loads, Use use) {
  use(LoadPlace{"", "load"}, loads.transverse);
  use(LoadPlace{"", "axial_load"}, loads.axial);
  use(LoadPlace{"", "heat"}, loads.heat);
  use(LoadPlace{"", "heat_gradient"}, loads.heat_gradient);
  use(LoadPlace{"ambient", "above"}, loads.ambient_above);
  use(LoadPlace{"ambient", "below"}, loads.ambient_below);
  for (int end = 0; end < 2; ++end) {
    use(LoadPlace{kEnds[end], "temperature"}, loads.mean[end]);
    use(LoadPlace{kEnds[end], "gradient"}, loads.gradient[end]);
  }
  for (int i = 0; i < static_cast<int>(loads.supports.size()); ++i) {
    const bool end = i < 2;  // the left and the right one, then those of the list
    const auto at = [&](const char* name) { return LoadPlace{end ? kEnds[i] : "supports", name, end ? -1 : i - 2}; };
    auto& [x, deflection, rotation, displacement] = loads.supports[i];
    use(at("deflection_at"), deflection.place);
    use(at("force"), deflection.force);
    use(at("rotation_at"), rotation.place);
    use(at("moment"), rotation.force);
    if (!end) continue;
    use(at("displacement_at"), displacement.place);
    use(at("axial_force"), displacement.force);
  }
}

void set_function(Source& load, Function function) {
  load.of = [f = std::move(function)](double x, double t) { return f.number(std::vector<double>{x, t}); };
}
void set_function(History& load, Function function) {
  load.of = [f = std::move(function)](double t) { return f.number(std::vector<double>{t}); };
}

// The arguments that a place is in; nothing where its table is not given.
std::optional<Arguments> holder(Call& call, const std::vector<Arguments>& supports, const LoadPlace& at) {
  if (at.table.empty()) return call;
  if (at.item >= 0) return supports[at.item];
  if (!call.has(at.table)) return std::nullopt;
  return call.table(at.table);
}

// Sets constants, and keeps functions with the beam at this stack index.
void take_loads(Call& call, const std::vector<Arguments>& supports, int beam, Loads& constants) {
  constants.supports.resize(2);
  constants.supports[1].x = call.number("length");
  for (const Arguments& s : supports) constants.supports.push_back({s.number("x"), {}, {}, {}});
  each_load(constants, [&](const LoadPlace& at, auto& load) {
    const auto from = holder(call, supports, at);
    if (!from || !from->has(at.name)) return;
    if (from->is(at.name, LUA_TNUMBER)) load.constant = from->number(at.name);
    else call.keep(beam, at.kept(), from->slot(at.name));
  });
}

// With the functions that are kept with the beam at this stack index.
Loads with_functions(const Call& call, int beam, Loads all) {
  each_load(all, [&](const LoadPlace& at, auto& load) {
    for (const Function& f : call.kept_function(beam, at.kept())) set_function(load, f);
  });
  return all;
}

Source at_first(const Arguments& from, const char* name) {
  Source out;
  if (from.is(name, LUA_TNUMBER)) out.constant = from.number(name);
  if (from.is(name, LUA_TFUNCTION)) out.of = [f = from.function(name)](double x, double) { return f.number(std::vector<double>{x}); };
  return out;
}

void take_laws(const Arguments& from, thermoelastic::Support& support) {
  support.deflection = law(from, "deflection");
  support.rotation = law(from, "rotation");
  stands_somewhere(from, "deflection");
  stands_somewhere(from, "rotation");
}

void add_end(Call& call, int end, Data& data) {
  data.supports.push_back({kEnds[end], end == 0 ? 0 : data.length, {}, {}, {}});
  if (!call.has(kEnds[end])) return;
  const Arguments from = call.table(kEnds[end]);
  take_laws(from, data.supports.back());
  data.supports.back().displacement = law(from, "displacement");
  stands_somewhere(from, "displacement");
  data.heat_ends[end] = {from.has("temperature"), from.has("gradient")};
}

// A constant, or a function of x; of a function the value in the middle is the constant.
void take_along(const Call& call, const char* name, double length, double& constant, std::function<double(double)>& of) {
  if (call.is(name, LUA_TFUNCTION)) of = [f = call.function(name)](double x) { return f.number(std::vector<double>{x}); };
  constant = of ? of(length / 2) : call.number(name);
}

Data given_data(Call& call, const std::vector<Arguments>& supports) {
  auto data = call.filled<Data>();
  take_along(call, "E", data.length, data.E, data.E_of);
  take_along(call, "expansion", data.length, data.expansion, data.expansion_of);
  if (call.has("exchange")) call.table("exchange").fill(data);
  add_end(call, 0, data);
  for (const Arguments& s : supports) {
    data.supports.push_back({text("x = ", s.number("x")), s.number("x"), {}, {}, {}});
    take_laws(s, data.supports.back());
  }
  add_end(call, 1, data);
  std::stable_sort(data.supports.begin(), data.supports.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return data;
}

Given<ThermoelasticBeam> make_thermoelastic_beam(Call& call) {
  const std::vector<Arguments> supports = call.tables("supports");
  const Data data = given_data(call, supports);
  auto beam = std::make_shared<ThermoelasticBeam>();
  const auto given = call.give_keeping(beam, {});
  const int object = lua_gettop(call.state());
  take_loads(call, supports, object, beam->constants);
  thermoelastic::Initial initial;
  if (call.has("initial")) initial = {at_first(call.table("initial"), "temperature"), at_first(call.table("initial"), "gradient")};
  auto scheme = call.filled<Scheme>();
  scheme.order = call.integer("order") == 1 ? thermoelastic::Order::one : thermoelastic::Order::two;
  if (call.has("solver")) scheme.method = call.object<Solver>("solver")->method;
  Watch watch(call.state(), "thermoelastic beam");
  beam->stepping = std::make_unique<Stepping>(data, initial, scheme, with_functions(call, object, beam->constants), watch);
  lua_settop(call.state(), object);
  return given;
}

Self run_to_time(Call& call) {
  const CalledLoads called(call, "step it");
  Watch watch(call.state(), "stepping");
  called.beam->stepping->run(call.number("time"), called.loads, watch);
  return call.give_self();
}

Self one_step(Call& call) {
  const CalledLoads called(call, "step it");
  Watch watch(call.state(), "stepping");
  called.beam->stepping->step(called.loads, watch);
  return call.give_self();
}

template <double (Stepping::*value)(double) const>
int value_now(Call& call) {
  return call.give(((*call.self<ThermoelasticBeam>()->stepping).*value)(call.number("x")));
}

int thermoelastic_reaction(Call& call) {
  const Stepping& s = *call.self<ThermoelasticBeam>()->stepping;
  const thermoelastic::Reaction r = s.reaction(find_support(thermoelastic::plain(s.data()), call, "at"));
  return call.give(Record{"reaction",
                          {{"force", r.force}, {"moment", r.moment}, {"axial", r.axial},
                           {"deflection", r.deflection}, {"rotation", r.rotation}, {"displacement", r.displacement}}});
}

std::vector<Record> broken(const ThermoelasticBeam& beam) {
  std::vector<Record> out;
  for (const auto& b : beam.stepping->broken()) out.push_back({"broken support", {{"name", b.name}, {"time", b.time}}});
  return out;
}

Record energy(const ThermoelasticBeam& beam) {
  const thermoelastic::Energy e = beam.stepping->energy();
  return {"energy", {{"stored", e.stored}, {"put_in", e.put_in}, {"dissipated", e.dissipated}, {"released", e.released}, {"defect", e.defect}}};
}

std::string thermoelastic_beam_text(const ThermoelasticBeam& beam) {
  const Stepping& s = *beam.stepping;
  const auto decomposed = s.decomposed();
  std::string out = text("thermoelastic_beam: time ", s.time(), " after ", s.steps(), " steps; ",
                         s.data().exchange_above == s.data().exchange_below ? "stretching and bending apart" : "stretching and bending coupled by the heat exchange", "; ");
  if (decomposed.empty()) out += "nothing decomposed";
  for (std::size_t i = 0; i < decomposed.size(); ++i) out += (i == 0 ? "" : " and ") + decomposed[i];
  if (!decomposed.empty()) out += " decomposed";
  for (const auto& b : s.broken()) out += text("\n  ", b.name, " broke at t = ", b.time);
  for (std::size_t i = 0; i < s.data().supports.size(); ++i) {
    const thermoelastic::Reaction r = s.reaction(static_cast<int>(i));
    out += text("\n  ", s.data().supports[i].name, ": force ", r.force, ", moment ", r.moment, ", axial ", r.axial, ", deflection ", r.deflection, ", rotation ", r.rotation,
                ", displacement ", r.displacement);
  }
  return out;
}

const char* kHelp =
    "A beam of rectangular section that heat bends and stretches, and whose deformation in turn cools and heats it: linear "
    "coupled thermoelasticity, quasi-static, stepped in time. At height z over its axis it is warmer than reference_temperature "
    "by temperature + z gradient. Every step is a contact problem like dotyk.beam's, condensed to the supports. Stretching and "
    "bending are apart where the heat exchange above and below is equal. Where statics alone gives the reactions (simply "
    "supported, cantilever, simply supported and guided, rigid or elastic, or forced to that by a condition of solvability) the "
    "heat is solved without the displacement (decomposed), with the same result. Without a law an end is free; without "
    "temperature (gradient) no heat passes there. A support whose law breaks bears nothing from then on: the step is divided there, and "
    "the beam jumps without exchanging heat. Functions are of x and t, or of t, and called in every step.";

const char* kBeam =
    "local l = dotyk.law\n"
    "local b = dotyk.thermoelastic_beam{ length = 1, height = 0.02, E = 2.1e11, expansion = 1.2e-5, conductivity = 50, heat_capacity = 3.8e6,\n"
    "  exchange = { above = 200, below = 200 }, ambient = { above = function(t) return 80*(1 - math.exp(-t/60)) end },\n"
    "  left = { deflection = l.signorini(), displacement = l.prescribed(0) }, right = { deflection = l.signorini() },\n"
    "  load = -100, step = 1 }\n";

Key varying(const char* name, const char* help) { return key::either(name, {key::number("", ""), key::function("", "")}, help); }

std::vector<Key> driven_support_keys() {
  return joined(support_law_keys(), {
      varying("deflection_at", "where the law of the deflection stands, a settlement: it is about the deflection less this; a function is of t").unit("length").otherwise("0"),
      varying("force", "up, beside the law; a function is of t").unit("force").otherwise("0"),
      varying("rotation_at", "where the law of the rotation stands; a function is of t").unit("rad").otherwise("0"),
      varying("moment", "anticlockwise, beside the law; a function is of t").unit("force·length").otherwise("0")});
}

Key end_key(const char* name, const char* help) {
  return key::table(name, joined(driven_support_keys(), {
      law_key("displacement", "a law about the displacement along the axis; one-sided ones keep the end within its place"),
      varying("displacement_at", "where that law stands; a function is of t").unit("length").otherwise("0"),
      varying("axial_force", "along x, beside the law; a function is of t").unit("force").otherwise("0"),
      varying("temperature", "prescribed, over the reference: a function is of t").unit("temperature").otherwise("no heat passes"),
      varying("gradient", "prescribed: a function is of t").unit("temperature/length").otherwise("no heat passes")}), help);
}

std::vector<Key> thermoelastic_beam_keys() {
  const Key inner = key::table("", joined({key::number("x", "where").unit("length").required()}, driven_support_keys()), "");
  return {key::positive("length", "from x = 0").unit("length").into(&Data::length),
          key::positive("height", "of the section").unit("length").required().into(&Data::height),
          key::positive("width", "of the section").unit("length").into(&Data::width),
          key::either("E", {key::positive("", ""), key::function("", "")}, "Young's modulus; a function is of x, taken at the middles of the cells").unit("stress").required(),
          key::either("expansion", {key::number("", "").at_least(0), key::function("", "")}, "coefficient of thermal expansion; a function is of x, as E").unit("1/temperature").required(),
          key::positive("conductivity", "of heat").unit("power/(length·temperature)").required().into(&Data::conductivity),
          key::positive("heat_capacity", "per volume").unit("energy/(length³·temperature)").required().into(&Data::heat_capacity),
          key::positive("reference_temperature", "absolute, at which it is free of stress").unit("temperature").into(&Data::reference),
          key::table("exchange", {key::number("above", "of the face z = height/2").at_least(0).unit("power/(length²·temperature)").into(&Data::exchange_above),
                                  key::number("below", "of the face z = -height/2").at_least(0).unit("power/(length²·temperature)").into(&Data::exchange_below)}, "coefficients of heat exchange on the faces"),
          key::table("ambient", {varying("above", "over the reference; a function is of t").unit("temperature").otherwise("0"),
                                 varying("below", "over the reference; a function is of t").unit("temperature").otherwise("0")}, "temperatures around, over the reference"),
          varying("load", "upwards: a function is of x and t").unit("force/length").otherwise("0"),
          varying("axial_load", "along x: a function is of x and t").unit("force/length").otherwise("0"),
          varying("heat", "supplied, the same at every height: a function is of x and t").unit("power/length³").otherwise("0"),
          varying("heat_gradient", "its slope over the height: a function is of x and t").unit("power/length⁴").otherwise("0"),
          end_key("left", "the end x = 0"),
          end_key("right", "the end x = length"),
          key::list("supports", inner, "supports within the beam, none along the axis; law.load there is a point load"),
          key::table("initial", {varying("temperature", "over the reference: a function is of x").unit("temperature").otherwise("0"),
                                 varying("gradient", "a function is of x").unit("temperature/length").otherwise("0")}, "at t = 0"),
          key::integer("cells", "elements, of equal length; a support within one divides it").within(1, 1000).into(&Data::cells),
          key::positive("step", "the longest step in time").unit("time").required().into(&Scheme::step),
          key::integer("order", "in time: 1, the implicit Euler scheme, or 2, TR-BDF2: half trapezoidal rule, half backward differences").within(1, 2).fallback(2.0),
          key::boolean("decompose", "solve the heat without the displacement where statics allows it").into(&Scheme::decompose),
          key::object<Solver>("solver", "the method of the steps' contact problems").otherwise("pdas")};
}

}  // namespace

CalledLoads::CalledLoads(const Call& call, const char* what) : beam(call.self<ThermoelasticBeam>()) {
  if (beam->loads_called) throw InputError(text("it is being stepped or drawn: a function of its loads cannot ", what));
  loads = with_functions(call, 1, beam->constants);
  beam->loads_called = true;
}

void bind_thermoelastic(Library& library) {
  library.function({.name = "dotyk.thermoelastic_beam", .help = kHelp, .setup = kBeam, .example = "print(b:run(60):deflection(0.5))", .arguments = {key::table(thermoelastic_beam_keys())},
                    .run = make_thermoelastic_beam});
  using B = ThermoelasticBeam;
  auto type = library.type<B>("A thermoelastic beam at a time.").setup(kBeam);
  type.field("time", "now", [](const B& b) { return b.stepping->time(); }, "time")
      .field("steps", "steps done", [](const B& b) { return b.stepping->steps(); })
      .field("decomposed", "effects, \"bending\" or \"stretching\", that were decomposed in every step since a support broke last", [](const B& b) { return b.stepping->decomposed(); })
      .field("energy", "stored, put_in, dissipated, and released where supports broke, since t = 0, and the defect of their balance, which tends to 0 with the step to the scheme's order where prescribed temperatures agree with the first ones", energy, "energy")
      .field("broken", "the supports that broke, in the order of time: name (\"right deflection\") and time", broken)
      .field("method", "of the contact problems; empty where all was decomposed", [](const B& b) { return b.stepping->work().method; })
      .field("reason", "how the last of them ended, and up to which motion it is unique", [](const B& b) { return b.stepping->work().reason; })
      .field("problems", "contact problems solved", [](const B& b) { return b.stepping->work().problems; })
      .field("iterations", "of the method, in all", [](const B& b) { return b.stepping->work().iterations; })
      .text(thermoelastic_beam_text);
  type.method({.name = "thermoelastic_beam:step", .help = "One step; gives the beam again.", .example = "print(b:step().time)", .run = one_step})
      .method({.name = "thermoelastic_beam:run", .help = "To a time by equal steps, none longer than the step; gives the beam again.", .example = "print(b:run(60).steps)",
               .arguments = {key::number("time", "the time to reach, not before now").required().unit("time")}, .run = run_to_time});
  add_value(type, "deflection", "The deflection now, positive upwards.", value_now<&Stepping::deflection>, "print(b:run(60):deflection(0.5))");
  add_value(type, "rotation", "The slope of the deflection now.", value_now<&Stepping::rotation>, "print(b:run(60):rotation(0))");
  add_value(type, "displacement", "The displacement along the axis now.", value_now<&Stepping::displacement>, "print(b:run(60):displacement(1))");
  add_value(type, "gradient", "The slope of the temperature over the height, now.", value_now<&Stepping::gradient>, "print(b:run(60):gradient(0.5))");
  add_value(type, "moment", "The bending moment -EJ (u'' + expansion gradient) now, by equilibrium.", value_now<&Stepping::moment>, "print(b:run(60):moment(0.5))");
  add_value(type, "shear", "The shear force now, the derivative of the moment.", value_now<&Stepping::shear>, "print(b:run(60):shear(0))");
  add_value(type, "normal", "The normal force now; a pull is positive.", value_now<&Stepping::normal>, "print(b:run(60):normal(0.5))");
  type.method({.name = "thermoelastic_beam:temperature", .help = "The temperature now, over the reference, at x and the height z over the axis.",
               .example = "print(b:run(60):temperature(0.5), b:temperature(0.5, 0.01))",
               .arguments = {x_key()[0], key::number("z", "over the axis").unit("length").fallback(0.0)},
               .run = [](Call& call) { return call.give(call.self<ThermoelasticBeam>()->stepping->temperature(call.number("x"), call.number("z"))); }});
  type.method({.name = "thermoelastic_beam:reaction",
               .help = "What a support does now: force (up), moment (anticlockwise) and axial force on the beam, and the deflection, rotation and displacement there.",
               .example = "print(b:run(60):reaction(\"left\").force)",
               .arguments = {support_key("at").required()},
               .run = thermoelastic_reaction});
}

}  // namespace dotyk::script

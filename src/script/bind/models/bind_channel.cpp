// The oscillating channel.
#include "channel/series.hpp"
#include "channel/stepping.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {

// Without a series where the magnetic field oscillates too slowly for it; `refusal` says so.
struct ChannelFlow {
  channel::Data data;
  std::optional<channel::Series> series;
  std::string refusal;
};
template <> struct Wrapped<ChannelFlow> : Called<"channel"> {};
template <> struct Wrapped<channel::Stepping> : Called<"channel_stepping"> {};

namespace {

using channel::Data;
using channel::Oscillating;
using channel::Physical;
using channel::Stepping;

std::vector<Key> physical_keys() {
  return {key::positive("density", "of the liquid").unit("kg/m^3").into(&Physical::density), key::positive("viscosity", "dynamic").unit("Pa s").into(&Physical::viscosity),
          key::positive("conductivity", "electric").unit("S/m").into(&Physical::conductivity),
          key::number("E0", "amplitude of the electric field").at_least(0).unit("V/m").otherwise("0").into(&Physical::E0),
          key::number("B0", "amplitude of the magnetic field").at_least(0).unit("T").otherwise("0").into(&Physical::B0),
          key::number("pressure_gradient", "dp/dx; negative drives the flow along x").unit("Pa/m").otherwise("0").into(&Physical::pressure_gradient)};
}

std::vector<Key> reduced_keys() {
  return {key::positive("a", "before u_t; reduced data, any consistent units").into(&Data::a), key::positive("b", "before -u_yy").into(&Data::b),
          key::number("c", "before u").at_least(0).otherwise("0").into(&Data::c), key::number("d", "the steady force").otherwise("0").into(&Data::d),
          key::number("drive", "the oscillating force").otherwise("1").into(&Data::drive)};
}

/// Keys that physical and reduced data have in common.
Key half_width_key() {
  return key::positive("half_width", "half the distance of the walls").required().unit("m").into(&Data::half_width).into(&Physical::half_width);
}
std::vector<Key> common_keys() {
  return {key::number("omega", "angular frequency").at_least(0).unit("1/s").into(&Data::omega).into(&Physical::omega),
          key::number("u0", "speed on the axis at t = 0; 0 starts from rest").unit("m/s").into(&Data::initial_speed).into(&Physical::initial_speed),
          key::choice<Oscillating>("oscillating", {{"electric", Oscillating::electric}, {"magnetic", Oscillating::magnetic}},
                                   "the field that oscillates; the other is steady").into(&Data::oscillating).into(&Physical::oscillating)};
}

/// The name of the first of the keys that is given; empty: none.
std::string first_given(const std::vector<Key>& keys, const Call& call) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return call.has(key.name); });
  return found == keys.end() ? "" : found->name;
}

Data reduced_data(Call& call) {
  if (const auto name = first_given(physical_keys(), call); !name.empty())
    throw InputError(text("'", name, "' is given beside reduced data; give density, viscosity, … or a, b, c, d, not both"));
  for (const char* name : {"a", "b"})
    if (!call.has(name)) throw InputError(text("'", name, "' is missing: reduced data need a and b"));
  const auto data = call.filled<Data>();
  channel::check(data);
  return data;
}

Data physical_data(Call& call) {
  for (const char* name : {"density", "viscosity", "conductivity"})
    if (!call.has(name)) throw InputError(text("'", name, "' is missing: give density, viscosity and conductivity, or reduced data a, b, c, d"));
  return channel::reduced(call.filled<Physical>());
}

std::shared_ptr<ChannelFlow> make_channel(Call& call) {
  auto flow = std::make_shared<ChannelFlow>();
  flow->data = !first_given(reduced_keys(), call).empty() ? reduced_data(call) : physical_data(call);
  try {
    flow->series.emplace(flow->data, static_cast<int>(call.integer("terms")));
  } catch (const InputError& error) {
    if (flow->data.oscillating == Oscillating::electric) throw;
    flow->refusal = error.what();
  }
  return flow;
}

const channel::Series& series(const ChannelFlow& flow) {
  if (!flow.series) throw InputError(flow.refusal + " (channel:stepping)");
  return *flow.series;
}

const char* kFlow =
    "local c = dotyk.channel{ half_width = 1e-3, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6,\n"
    "                         E0 = 0.1, B0 = 0.2, pressure_gradient = -2e4, omega = 6.28, u0 = 1 }\n";

Key y_key_or_axis() { return key::number("y", "distance from the axis, |y| <= half_width").fallback(0.0).unit("length"); }
Key y_key() { return key::number("y", "distance from the axis, |y| <= half_width").required().unit("length"); }
Key t_key() { return key::number("t", "time, not negative").required().unit("time"); }

void add_fields(TypeOf<ChannelFlow>& type) {
  using F = ChannelFlow;
  type.field("half_width", "half the distance of the walls", [](const F& f) { return f.data.half_width; }, "length")
      .field("a", "before u_t", [](const F& f) { return f.data.a; })
      .field("b", "before -u_yy", [](const F& f) { return f.data.b; })
      .field("c", "before u, or u cos(omega t)^2", [](const F& f) { return f.data.c; })
      .field("d", "the steady force", [](const F& f) { return f.data.d; })
      .field("drive", "the oscillating force", [](const F& f) { return f.data.drive; })
      .field("omega", "angular frequency", [](const F& f) { return f.data.omega; }, "1/time")
      .field("u0", "speed on the axis at t = 0", [](const F& f) { return f.data.initial_speed; }, "velocity")
      .field("hartmann", "Hartmann's number half_width sqrt(c/b)", [](const F& f) { return channel::hartmann(f.data); })
      .field("reynolds", "sqrt(2) half_width u0 a/b", [](const F& f) { return channel::reynolds(f.data); })
      .field("exponent", "of the initial profile, log10(reynolds + 1)", [](const F& f) { return channel::exponent(f.data); })
      .text([](const F& f) {
        return text("channel: ", f.data.oscillating == Oscillating::electric ? "electric" : "magnetic", " field oscillating, a = ",
                    f.data.a, ", b = ", f.data.b, ", c = ", f.data.c, ", d = ", f.data.d, ", omega = ", f.data.omega,
                    ", Hartmann's number ", channel::hartmann(f.data), ", Re ", channel::reynolds(f.data));
      });
}

void add_states(TypeOf<ChannelFlow>& type) {
  const auto at = [](Call& call) -> const channel::Series& { return series(*call.self<ChannelFlow>()); };
  type.method({.name = "channel:velocity",
               .help = "u(y, t): the periodic state in closed form and the transient as a series in cos((2k+1) pi y/(2 half_width)), "
                       "summed to rounding where the terms suffice (error_bound says).",
               .example = "for i = 0, 10 do print(i/10, c:velocity(0, i/10)) end",
               .arguments = {y_key(), t_key()},
               .run = [at](Call& call) { return call.give(at(call).velocity(call.number("y"), call.number("t"))); }})
      .method({.name = "channel:periodic",
               .help = "What velocity(y, t) tends to: the periodic state at time t, in closed form.",
               .example = "print(c:velocity(0, 20) - c:periodic(0, 20))",
               .arguments = {y_key(), t_key()},
               .run = [at](Call& call) { return call.give(at(call).periodic(call.number("y"), call.number("t"))); }})
      .method({.name = "channel:stationary",
               .help = "Hartmann's profile d/c (1 - cosh(M y/half_width)/cosh M) of the steady channel -b u'' + c u = d, M Hartmann's "
                       "number; d (half_width^2 - y^2)/(2b) for c = 0. The magnetic field is taken at its amplitude.",
               .example = "print(c:stationary(0), c:stationary(0.9e-3))",
               .arguments = {y_key()},
               .run = [](Call& call) { return call.give(channel::stationary(call.self<ChannelFlow>()->data, call.number("y"))); }})
      .method({.name = "channel:amplitude",
               .help = "Amplitude of the velocity's fluctuation at omega in the periodic state: of the part that varies as "
                       "cos(omega t + phase). Tends to drive/(a omega) away from the walls as omega grows.",
               .example = "print(c:amplitude(), c:amplitude(0.9e-3), 1/(c.a*c.omega))",
               .arguments = {y_key_or_axis()},
               .run = [at](Call& call) { return call.give(at(call).amplitude(call.number("y"))); }})
      .method({.name = "channel:error_bound",
               .help = "A bound, for all y, of what the terms left out of velocity(y, t) could add; rounding is not in it. Large only "
                       "for times so short that all the terms do not suffice.",
               .example = "print(c:error_bound(1e-6), c:error_bound(1e-2))",
               .arguments = {key::positive("t", "time; at 0 velocity is the profile it starts from, and no series").required().unit("time")},
               .run = [at](Call& call) { return call.give(at(call).truncation_bound(call.number("t"))); }})
      .method({.name = "channel:stepping",
               .help = "The same flow from t = 0 on, stepped in time independently of the series: finite elements of any degree on half the "
                       "channel, cells crowded at the wall, and Radau IIA of order 5.",
               .example = "local s = c:stepping{ step = 0.01 }:run(0.5)\nprint(s:velocity(0) - c:velocity(0, 0.5))",
               .arguments = {key::table({key::positive("step", "longest step").required().unit("time"),
                                         key::integer("cells", "on half the channel").within(1, 4096).fallback(16.0),
                                         key::integer("degree", "of the elements").within(1, 16).fallback(8.0)})},
               .run = [](Call& call) {
                 return std::make_shared<Stepping>(call.self<ChannelFlow>()->data, call.number("step"), static_cast<int>(call.integer("cells")),
                                                   static_cast<int>(call.integer("degree")));
               }});
}

Self advance(Call& call) {
  const auto s = call.self<Stepping>();
  Watch watch(call.state(), "stepping");
  s->advance(call.number("time"), watch);
  return call.give_self();
}

void bind_stepping(Library& library) {
  library.type<Stepping>("A channel's flow stepped in time by finite elements.")
      .setup(std::string(kFlow) + "local s = c:stepping{ step = 0.01 }\n")
      .field("time", "now", [](const Stepping& s) { return s.time(); }, "time")
      .field("steps", "steps done", [](const Stepping& s) { return s.steps(); })
      .method({.name = "channel_stepping:step",
               .help = "Steps by one step; gives the object again.",
               .example = "s:step():step()\nprint(s.time)",
               .run = [](Call& call) {
                 call.self<Stepping>()->step();
                 return call.give_self();
               }})
      .method({.name = "channel_stepping:run",
               .help = "Steps to a time by equal steps, none longer than the step; gives the object again.",
               .example = "print(s:run(0.5):velocity(0))",
               .arguments = {key::number("time", "the time to reach, not before now").required().unit("time")},
               .run = advance})
      .method({.name = "channel_stepping:velocity",
               .help = "u(y) now.",
               .example = "s:step()\nprint(s:velocity(0) - c:velocity(0, s.time))",
               .arguments = {y_key()},
               .run = [](Call& call) { return call.give(call.self<Stepping>()->velocity(call.number("y"))); }})
      .text([](const Stepping& s) { return text("channel_stepping: time ", s.time(), " after ", s.steps(), " steps"); });
}

}  // namespace

void bind_channel(Library& library) {
  auto keys = joined(joined({half_width_key()}, physical_keys()), joined(reduced_keys(), common_keys()));
  keys.push_back(key::integer("terms", "most terms of the transient's series").within(64, 1 << 20).fallback(4096.0));
  library.function({
      .name = "dotyk.channel",
      .help =
          "Oscillating flow of a conducting liquid between walls y = -half_width and half_width, across a magnetic field B "
          "along y, driven by an electric field E along z and a pressure gradient: the modified Hartmann problem\n"
          "  a u_t - b u_yy + c u = d + drive cos(omega t),   u = 0 at the walls,\n"
          "with c cos(omega t)^2 in place of c where the magnetic field oscillates. Physical data, E = -E0 cos(omega t) and "
          "B = B0, or E = -E0 and B = B0 cos(omega t): a = density/s, b = viscosity/s, c = conductivity B0^2/s, "
          "d = -pressure_gradient/s, s = conductivity E0 B0, drive = 1 (s = 1 and drive = 0 where E0 or B0 is 0). Or the reduced "
          "data a, b, c, d, drive themselves. It starts from u0 (1 - (|y|/half_width)^p), p = log10(Re + 1), "
          "Re = sqrt(2) half_width u0 a/b.",
      .setup = kFlow,
      .example = "print(c:velocity(0, 0.5), c:stationary(0), c:amplitude())",
      .arguments = {key::table(std::move(keys))},
      .run = make_channel});
  auto type = library.type<ChannelFlow>("Oscillating flow in a magnetohydrodynamic channel.").setup(kFlow);
  add_fields(type);
  add_states(type);
  bind_stepping(library);
}

}  // namespace dotyk::script

#include "script/bind/models/models.hpp"

#include "beam/element.hpp"
#include "script/bind/bind.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::script {
using problem::LawChoice;

bool stands_somewhere(const Arguments& from, const char* name) {
  const std::string at = std::string(name) + "_at";
  if (!from.has(at)) return false;
  const LawChoice given = law(from, name);
  if (!given->acts() || given->load)
    throw InputError(text("'", at, "' is where the law of '", name, "' stands, and that is ", given.spec->words, "; give a law that acts somewhere, as dotyk.law.signorini()"));
  return true;
}

namespace {

using beam::Beam;
using beam::Broken;
using beam::PointLoad;

beam::Support beam_support(const Arguments& from, std::string name, double x) {
  beam::Support out{std::move(name), x, law(from, "deflection"), law(from, "rotation")};
  if (stands_somewhere(from, "deflection")) out.deflection_at = from.number("deflection_at");
  if (stands_somewhere(from, "rotation")) out.rotation_at = from.number("rotation_at");
  return out;
}

std::vector<Key> beam_support_keys() {
  return joined(support_law_keys(),
                {key::number("deflection_at", "where the law of the deflection stands: it is about the deflection less this").unit("length").otherwise("0"),
                 key::number("rotation_at", "the same of the rotation").unit("rad").otherwise("0")});
}

/// Laws at the nodes.
void take_foundation(Call& call, Beam& beam) {
  if (!call.has("foundation")) {
    if (call.has("foundation_at")) throw InputError("'foundation_at' is where the foundation stands, and there is none; give 'foundation', a law of dotyk.law or a function of x");
    return;
  }
  const LawOfPlace law = law_field_without_normal(call, "foundation");
  const std::optional<Field> at = call.has("foundation_at") ? std::optional<Field>(call.field("foundation_at")) : std::nullopt;
  for (const double x : beam::nodes(beam)) {
    const std::vector<double> point{x};
    beam.foundation.push_back({law(point), at ? (*at)(point)[0] : 0});
  }
}

void add_end(Call& call, const char* name, double x, Beam& beam) {
  if (call.has(name)) beam.supports.push_back(beam_support(call.table(name), name, x));
  else beam.supports.push_back({name, x, {}, {}});
}

std::shared_ptr<Beam> make_beam(Call& call) {
  const auto beam = std::make_shared<Beam>(call.filled<Beam>());
  add_end(call, "left", 0, *beam);
  for (const Arguments& s : call.tables("supports")) beam->supports.push_back(beam_support(s, text("x = ", s.number("x")), s.number("x")));
  add_end(call, "right", beam->length, *beam);
  std::stable_sort(beam->supports.begin(), beam->supports.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  for (const Arguments& load : call.tables("loads")) beam->loads.push_back(load.filled<PointLoad>());
  require_valid(*beam);
  const auto sampled = [&](const Field& field) {  // at points of every cell
    return beam::sampled([&](double x) { return field(std::vector<double>{x})[0]; }, beam::nodes(*beam));
  };
  take_field(call, "EJ", beam->EJ, beam->EJ_of, sampled);
  take_field(call, "load", beam->q, beam->q_of, sampled);
  take_foundation(call, *beam);
  beam::build(*beam);  // refuses at once what cannot be solved
  return beam;
}

std::string beam_text(const Beam& b) {
  return text("beam: length ", b.length, ", ", b.cells, " cells, EJ ", b.EJ_of ? "a function" : text(b.EJ), ", load ",
              b.q_of ? "a function" : text(b.q), ", ", b.supports.size(), " supports, ", b.loads.size(), " point loads",
              b.foundation.empty() ? "" : ", on a foundation");
}

template <double (beam::Solution::*value)(double) const>
int value_at(Call& call) {
  return call.give((call.self<BeamResult>()->solution().*value)(call.number("x")));
}

int beam_reaction(Call& call) {
  const beam::Solution& s = call.self<BeamResult>()->solution();
  const beam::Reaction r = s.reaction(find_support(s.beam(), call, "at"));
  return call.give(Record{"reaction", {{"force", r.force}, {"moment", r.moment}, {"deflection", r.deflection}, {"rotation", r.rotation}}});
}

std::vector<std::shared_ptr<BeamResult>> branches(const BeamResult& r) {
  std::vector<std::shared_ptr<BeamResult>> out;
  for (std::size_t k = 0; k < r.branches.size(); ++k) {
    out.push_back(std::make_shared<BeamResult>(r));
    out.back()->shown = k;
  }
  return out;
}

/// Names of the supports that are broken, "left rotation".
std::vector<std::string> broken(const BeamResult& r) {
  std::vector<std::string> out;
  const auto which = beam::breaking(r.solution().beam());
  const auto& choice = r.branches[r.shown].broken;
  for (std::size_t k = 0; k < which.size(); ++k)
    if (choice[k] == Broken::yes)
      out.push_back(r.solution().beam().supports[which[k].support].name + (which[k].rotation ? " rotation" : " deflection"));
  return out;
}

std::string show_result(const BeamResult& r) {
  const beam::Solution& s = r.solution();
  const solver::Result& result = s.result();
  std::string out = text("beam solution: ", solver::ending(result), "\n  energy ", s.energy());
  if (r.branches.size() > 1) out += text(", the ", r.shown + 1, ". of ", r.branches.size(), " local minima");
  out += "\n  residual: " + problem::describe(s.residual());
  for (std::size_t i = 0; i < s.beam().supports.size(); ++i) {
    const beam::Reaction at = s.reaction(static_cast<int>(i));
    out += text("\n  ", s.beam().supports[i].name, ": force ", at.force, ", moment ", at.moment, ", deflection ", at.deflection, ", rotation ", at.rotation);
  }
  if (!s.beam().foundation.empty()) {
    double force = 0;
    for (std::size_t i = 0; i < s.model().nodes.size(); ++i) force += s.foundation_force(static_cast<int>(i));
    out += text("\n  foundation: force ", force);
  }
  return out;
}

void bind_beam_solution(Library& library) {
  auto type = library.type<BeamResult>("A solved beam: what it does, how it ended, and its other branches.").setup(setup::solved_beam());
  type.field("converged", "did the method end as it should", [](const BeamResult& r) { return r.solution().result().converged; })
      .field("method", "which method", [](const BeamResult& r) { return r.solution().result().method; })
      .field("iterations", "how many", [](const BeamResult& r) { return r.solution().result().iterations; })
      .field("reason", "why it ended", [](const BeamResult& r) { return r.solution().result().reason; })
      .field("residual", "relative: equilibrium penetration complementarity law", [](const BeamResult& r) { return residual_record(r.solution().residual()); })
      .field("energy", "with the supports'", [](const BeamResult& r) { return r.solution().energy(); }, "force·length")
      .field("unknowns", "deflections and slopes of the nodes", [](const BeamResult& r) { return r.solution().model().problem.unknowns(); })
      .field("rows", "conditions of the supports", [](const BeamResult& r) { return r.solution().model().problem.rows(); })
      .field("time", "seconds: total assembly motions ordering factor iterate recover, of this branch", [](const BeamResult& r) { return time_record(r.solution().result().clock); }, "s")
      .field("branches", "all local minima of the energy, the least first: more than one only with breaking supports", branches)
      .field("broken", "names of the breaking supports that are broken here", broken);
  add_value(type, "deflection", "The deflection, positive upwards; at nodes exact where EJ is constant.", value_at<&beam::Solution::deflection>, "print(s:deflection(0.5))");
  add_value(type, "rotation", "The slope of the deflection.", value_at<&beam::Solution::rotation>, "print(s:rotation(0))");
  add_value(type, "moment", "The bending moment -EJ u'', by equilibrium.", value_at<&beam::Solution::moment>, "print(s:moment(0.5))");
  add_value(type, "shear", "The shear force, the derivative of the moment, by equilibrium; where it jumps, to the right.", value_at<&beam::Solution::shear>, "print(s:shear(0))");
  add_value(type, "pressure", "The force per length of the foundation on the beam, positive upwards; linear between nodes, 0 without a foundation.",
            value_at<&beam::Solution::pressure>, "print(dotyk.solve(dotyk.beam{ load = -1, foundation = dotyk.law.elastic(100) }):pressure(0.5))");
  type.method({.name = "beam_solution:reaction",
               .help = "What a support does to the beam: force (up) and moment (anticlockwise), and the deflection and rotation there.",
               .example = "print(s:reaction(\"left\").force, s:reaction(0.5).force)",
               .arguments = {support_key("at").required()},
               .run = beam_reaction})
      .text(show_result);
}

}  // namespace

Key support_key(std::string name) {
  return key::either(std::move(name), {key::choice("", {"left", "right"}, ""), key::number("", "the x of a support")}, "an end, or the x of a support");
}

int find_support(const Beam& beam, const Arguments& from, const std::string& name) {
  const auto& supports = beam.supports;
  const bool at_x = from.is(name, LUA_TNUMBER);
  std::string known;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const bool found = at_x ? std::abs(supports[i].x - from.number(name)) <= 1e-9 * beam.length : supports[i].name == from.text(name);
    if (found) return static_cast<int>(i);
    known += (known.empty() ? "" : ", ") + supports[i].name;
  }
  throw InputError(text("no support there; the supports are ", known));
}

void bind_beam(Library& library) {
  library.function(
      {.name = "dotyk.beam",
       .help = "A straight beam (Bernoulli's hypothesis, cubic elements) with supports at its ends and within, each with a law for the deflection and "
               "one for the rotation. Solved by dotyk.solve or a solver. A foundation is a law along its length. Functions are taken at eight points of every cell, when the beam is made.",
       .example = "local b = dotyk.beam{ length = 1, EJ = 1, load = -1,\n"
                  "  left = { deflection = dotyk.law.signorini() }, right = { deflection = dotyk.law.signorini() } }\n"
                  "print(dotyk.solve(b):deflection(0.5))",
       .arguments = {key::table(
           {law_field_key("foundation",
                        "a law per length about the deflection, or a function of x that gives one; taken at the nodes, each for half of the cells about it").otherwise("none"),
            key::field("foundation_at", "where it stands: the law is about the deflection less this; a number or a function of x").unit("length").otherwise("0"),
            key::positive("length", "of the beam, from x = 0").unit("length").into(&Beam::length),
            key::field("EJ", "bending stiffness, positive").unit("force·length²").otherwise("1"),
            key::integer("cells", "elements, of equal length; a support within one divides it. Rounding grows as the fourth power: 1e-12 with 32, 1e-6 with 1000").within(1, 1000).into(&Beam::cells),
            key::field("load", "per length, upwards: a number or a function of x").unit("force/length").otherwise("0"),
            key::table("left", beam_support_keys(), "the support at x = 0"), key::table("right", beam_support_keys(), "the support at x = length"),
            key::list("supports", key::table("", joined({key::number("x", "where").unit("length").required()}, beam_support_keys()), ""), "supports within the beam"),
            key::list("loads", key::table("", {key::number("x", "where").unit("length").required().into(&PointLoad::x), key::number("force", "upwards").unit("force").into(&PointLoad::force),
                                               key::number("moment", "anticlockwise").unit("force·length").into(&PointLoad::moment)}, ""), "at points")})},
       .run = make_beam});
  library.type<Beam>("A beam with its supports and loads.").field("length", "of the beam", [](const Beam& b) { return b.length; }, "length").text(beam_text);
  bind_beam_solution(library);
}

}  // namespace dotyk::script

#include "figure/compose/compose_beam.hpp"

#include <algorithm>
#include <cmath>

#include "solver/core/verdict.hpp"

namespace dotyk::figure {

namespace {

double most(const std::vector<double>& nodes, const std::function<double(double)>& of) {
  double out = 0;
  for (const double x : nodes) out = std::max(out, std::abs(of(x)));
  return out;
}

/// Forces at points and of supports, moments as forces over the length.
double greatest_force(const BeamView& view) {
  double sum = 0, out = 0;
  for (const BeamLoad& p : view.loads) sum += std::abs(p.force) + std::abs(p.moment) / view.length;
  for (const ViewedSupport& s : view.supports) out = std::max({out, std::abs(s.deflection.reaction), std::abs(s.rotation.reaction) / view.length});
  return std::max({sum, out, view.load ? most(view.nodes, view.load) * view.length : 0});
}

/// A strain ε is a deflection of εL, or a displacement of εL; what is no more than rounding of it is none.
Scales positive(double displacement, double strain, double force, double length) {
  if (displacement <= kRounding * strain * length) displacement = strain * length;
  return {displacement > 0 ? displacement : length, force > 0 ? force : 1};
}

/// M and T, which jump by what acts at points.
void add_bending_diagrams(BeamView& view, std::function<double(double)> moment, std::function<double(double)> shear) {
  Diagram M{std::move(moment), {}, view.bending.force * view.length}, T{std::move(shear), {}, view.bending.force};
  const auto acts = [&](double x, double force, double by) { M.jumps.push_back({x, by}), T.jumps.push_back({x, -force}); };
  for (const BeamLoad& load : view.loads) acts(load.x, load.force, load.moment);
  for (const ViewedSupport& s : view.supports) acts(view.nodes[beam::nearest(view.nodes, s.x)], s.deflection.reaction, s.rotation.reaction);
  view.diagrams[BeamPanel::moment] = std::move(M), view.diagrams[BeamPanel::shear] = std::move(T);
}

ViewedLaw viewed(const problem::LawChoice& law, double displacement, double reaction, LawSide of, const thermoelastic::Driven& driven = {}, bool right_end = false) {
  const double load = law.force();
  return {law, displacement, reaction, turned(law, of, right_end), driven.place, driven.force - load};
}

}  // namespace

const ViewedLaw& ViewedSupport::of(LawSide side) const {
  return side == LawSide::deflection ? deflection : side == LawSide::rotation ? rotation : displacement;
}

bool turned(const problem::LawChoice& law, LawSide of, bool right_end) {
  return (of == LawSide::rotation || (of == LawSide::displacement && right_end)) && law->directed();
}

Scales scales(const BeamView& view, LawSide of) {
  if (of == LawSide::displacement) return view.axial;
  const auto [u, force] = view.bending;
  return of == LawSide::deflection ? view.bending : Scales{u / view.length, force * view.length};
}

BeamView view(const beam::Solution& s) {
  const beam::Beam& b = s.beam();
  BeamView out;
  out.length = b.length;
  out.doubt = solver::doubt(s.result());
  out.nodes = s.model().nodes;
  out.deflection = [&s](double x) { return s.deflection(x); };
  if (b.q_of || b.q != 0) out.load = [&b](double x) { return b.q_of ? b.q_of(x) : b.q; };
  for (const beam::PointLoad& load : b.loads) out.loads.push_back({load.x, load.force, load.moment});
  for (std::size_t i = 0; i < b.supports.size(); ++i) {
    const beam::Support& support = b.supports[i];
    const auto at = [](const problem::LawChoice& law, double place) {
      return thermoelastic::Driven{place, law.force()};
    };
    const beam::Reaction r = s.reaction(static_cast<int>(i));
    out.supports.push_back({support.x, viewed(support.deflection, r.deflection, r.force, LawSide::deflection, at(support.deflection, support.deflection_at)),
                            viewed(support.rotation, r.rotation, r.moment, LawSide::rotation, at(support.rotation, support.rotation_at)), {}});
  }
  for (std::size_t i = 0; i < s.model().foundation.size(); ++i)
    if (const double force = s.foundation_force(static_cast<int>(i)); force != 0) out.loads.push_back({out.nodes[i], force, 0});
  const double u = most(out.nodes, out.deflection), EJ = b.EJ_of ? b.EJ_of(b.length / 2) : b.EJ;
  out.bending = positive(u, 0, std::max(greatest_force(out), EJ * u / (b.length * b.length * b.length)), b.length);
  add_bending_diagrams(out, [&s](double x) { return s.moment(x); }, [&s](double x) { return s.shear(x); });
  return out;
}

BeamView view(const thermoelastic::Stepping& s, std::function<double(double)> load) {
  const thermoelastic::Data& data = s.data();
  const double L = data.length;
  BeamView out;
  out.length = L;
  out.nodes = thermoelastic::nodes(data);
  out.deflection = [&s](double x) { return s.deflection(x); };
  out.load = std::move(load);
  double axial_force = 0;
  for (std::size_t i = 0; i < data.supports.size(); ++i) {
    const thermoelastic::Support& support = data.supports[i];
    const thermoelastic::Reaction r = s.reaction(static_cast<int>(i));
    out.supports.push_back({support.x, viewed(support.deflection, r.deflection, r.force, LawSide::deflection, r.driven[0]),
                            viewed(support.rotation, r.rotation, r.moment, LawSide::rotation, r.driven[1]),
                            viewed(support.displacement, r.displacement, r.axial, LawSide::displacement, r.driven[2], i + 1 == data.supports.size())});
    axial_force = std::max(axial_force, std::abs(r.axial));
  }
  const auto field = [&](BeamPanel panel, double (thermoelastic::Stepping::*of)(double) const) {
    out.diagrams[panel].value = [&s, of](double x) { return (s.*of)(x); };
    return most(out.nodes, out.diagrams[panel].value);
  };
  out.diagrams[BeamPanel::temperature].value = [&s](double x) { return s.temperature(x); };
  const thermoelastic::Coefficients c(data);
  // Strains and curvatures that heat alone would cause; supports may keep them from being seen.
  const double strain = data.expansion * most(out.nodes, out.diagrams[BeamPanel::temperature].value);
  const double curvature = data.expansion * field(BeamPanel::gradient, &thermoelastic::Stepping::gradient);
  const double u = most(out.nodes, out.deflection), along = field(BeamPanel::displacement, &thermoelastic::Stepping::displacement);
  const double pull = field(BeamPanel::normal, &thermoelastic::Stepping::normal);
  out.bending = positive(u, curvature * L, std::max({greatest_force(out), data.E * c.J * u / (L * L * L), data.E * c.J * curvature / L}), L);
  out.axial = positive(along, strain, std::max({axial_force, pull, data.E * c.F * along / L, data.E * c.F * strain}), L);
  out.diagrams[BeamPanel::displacement].scale = out.axial.displacement;
  out.diagrams[BeamPanel::normal].scale = out.axial.force;
  add_bending_diagrams(out, [&s](double x) { return s.moment(x); }, [&s](double x) { return s.shear(x); });
  return out;
}

}  // namespace dotyk::figure

#include "scene/result/energy_norm.hpp"

#include <cmath>

#include "elasticity/assembly.hpp"

namespace dotyk::scene {
namespace {

using Kind = problem::SupportLaw::Kind;

double along(const contact::NodeSide& side, const mesh::Point& direction, const std::vector<double>& v, int dimension) {
  double sum = 0;
  for (const contact::NodeWeight& own : side.own)
    for (int i = 0; i < dimension; ++i) sum += own.weight * v[static_cast<std::size_t>(own.node) * dimension + i] * direction[i];
  return sum;
}

double squared_of_laws(const Solution& at, int index, const std::vector<double>& v) {
  const Body& body = at.body(index);
  const int dim = body.dimension();
  double sum = 0;
  for (std::size_t s = 0; s < body.laws.size(); ++s) {
    const LawSupport& support = body.laws[s];
    for (std::size_t k = 0; k < support.nodes.size(); ++k) {
      const contact::NodeSide& side = support.nodes[k];
      const auto add = [&](const problem::SupportLaw& law, int row, const mesh::Point& direction) {
        if (row < 0 || (law.kind != Kind::elastic && !at.active(row))) return;
        const double moved = along(side, direction, v, dim);
        sum += side.weight * spring_stiffness(law, along(side, direction, at.displacement(index), dim)) * moved * moved;
      };
      const SupportRows& rows = at.model().support_row[index][s][k];
      if (!support.breaks(k)) add(support.normal, rows.normal, side.normal);
      for (int i = 0; i < rows.count; ++i) add(support.tangential, rows.row[i], rows.direction[i]);
    }
  }
  return sum;
}

}  // namespace

double spring_stiffness(const problem::SupportLaw& law, double x) {
  switch (law.kind) {
    case Kind::elastic:
    case Kind::one_sided_elastic:
    case Kind::capped_elastic:
    case Kind::breaking: return law.value;
    case Kind::unequal_elastic: return x < 0 ? law.pull : law.value;
    case Kind::free:
    case Kind::prescribed:
    case Kind::load:
    case Kind::signorini:
    case Kind::friction:
    case Kind::one_sided_friction:
    case Kind::coulomb: return 0;
    case Kind::compliance: return x > 0 ? law.value * law.power * std::pow(x, law.power - 1) : 0;
  }
  return 0;
}

double squared_energy_norm(const Solution& at, int index, const std::vector<double>& v) {
  const Body& body = at.body(index);
  const std::vector<double> force = elasticity::internal_force(*body.mesh, body.material, body.facet_springs(), v);
  double sum = 0;
  for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] * force[k];
  return sum + squared_of_laws(at, index, v);
}

}  // namespace dotyk::scene

#include "problem/residual.hpp"

#include <iomanip>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/generalised_inverse.hpp"

namespace dotyk::problem {

using algebra::Vector;

namespace {

/// g = λ − P(λ + ρx) falls as x rises. The least |g| where x may be off by `rounding`.
double distance(const Law& law, int k, double lambda, double x, double rho, double rounding) {
  const auto off = [&](double at) { return lambda - law.project(k, lambda + rho * at, rho).lambda; };
  if (rounding == 0) return std::abs(off(x));
  return std::max({0.0, -off(x - rounding), off(x + rounding)});
}

/// Of a point of friction likewise; slip that may be rounding counts as none.
double distance(const FrictionGroup& group, int k, const Vector& lambda, const Vector& x, double rho, double rounding) {
  const int r = group.row(k);
  const auto own = lambda.segment(r, group.components);
  const Vector slip = x.segment(r, group.components);
  const double bound = group.bound(k, lambda), size = slip.norm();
  const auto off = [&](double part) {
    const Vector y = own + rho * part * slip;
    return (own - disc_factor(y.norm(), bound) * y).norm();
  };
  return rounding == 0 ? off(1) : std::min(off(1), off(size > rounding ? 1 - rounding / size : 0));
}

/// By row the distance |λ − P(λ + ρx)|; of a friction point at its first row, with the ρ of its scale_row(). `rho`, `rounding`: functions of a row.
template <class Rho, class Rounding>
Vector distances(const Problem& problem, const Vector& x, const Vector& lambda, const Rho& rho, const Rounding& rounding) {
  Vector d = Vector::Zero(lambda.size());
  for (const auto& [law, k, r] : problem.scalar_rows()) d[r] = distance(law, k, lambda[r], x[r], rho(r), rounding(r));
  for (const auto& [group, k, first, n] : problem.friction_points()) d[first] = distance(group, k, lambda, x, rho(group.scale_row(k)), rounding(first));
  return d;
}

double none(int) { return 0; }

}  // namespace

Vector distances_from_laws(const Problem& problem, const Vector& x, const Vector& lambda, const Vector& rho, const Vector& rounding) {
  const auto of = [](const Vector& v) { return [&v](int r) { return v[r]; }; };
  return rounding.size() > 0 ? distances(problem, x, lambda, of(rho), of(rounding)) : distances(problem, x, lambda, of(rho), none);
}

double natural_residual(const Problem& problem, const Vector& x, const Vector& lambda, const Vector& rho) {
  const double scale = lambda.norm();
  return distances_from_laws(problem, x, lambda, rho).norm() / (scale > 0 ? scale : 1);
}

namespace {

double energy(const Problem& problem, const Forces& forces, const Vector& x) {
  double e = 0.5 * forces.u->dot(*forces.internal) - (forces.load ? forces.u->dot(*forces.load) : 0);
  for (const Block& block : problem.blocks) e += block.offset;
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      e += group.law->energy(r - group.first, x[r]);
  return e;
}

}  // namespace

double energy(const Problem& problem, const State& state) { return energy(problem, forces(problem, state), jumps(problem, state.u)); }

double friction_energy(const Problem& problem, const State& state) {
  const Vector x = jumps(problem, state.u);
  double e = 0;
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      e += group.bound(k, state.lambda) * x.segment(group.row(k), group.components).norm();
  return e;
}

namespace {

/// The greatest of all parts' numbers relative to their scales, of those that have one.
template <class Scale>
double greatest_ratio(const std::vector<double>& of_part, const Scale& scale) {
  double most = 0;
  for (std::size_t p = 0; p < of_part.size(); ++p)
    if (const double size = scale(p); size > 0) most = std::max(most, of_part[p] / size);
  return most;
}

/// ‖|K||w|‖, w the part of u in the block's kernel.
double moved_forces(const Block& block, const Vector& u) {
  return block.K.gross_times(rigid_part(block, u)).stableNorm();
}

/// Greatest resultant of the forces on the block that is not balanced, relative to all of them (`gross`) at the longest lever.
double unbalanced(const Block& block, const Vector& force, double gross) {
  double most = 0;
  for (const auto& mode : block.kernel.colwise())
    most = std::max(most, std::abs(mode.dot(force)) / (mode.lpNorm<Eigen::Infinity>() * gross));
  return gross > 0 ? most : 0;
}

}  // namespace

MotionResidual motion_residual(const Problem& problem, const State& state) {
  constexpr double kRoundings = 4;  // of u itself and of the sums in Ku
  const Forces all = forces(problem, state);
  const Measure m(problem, state, all);
  const Vector internal = all.internal->get(), load = all.load ? all.load->get() : Vector(Vector::Zero(problem.unknowns())),
               external = problem.B.transpose() * state.lambda - load, gross = algebra::SparseRows(problem.B.cwiseAbs()).transpose() * state.lambda.cwiseAbs() + load.cwiseAbs();
  std::vector<double> beyond(static_cast<std::size_t>(m.parts().count), 0);
  MotionResidual result;
  double greatest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto part = static_cast<std::size_t>(m.parts().of_block[b]);
    const auto own = [&](const Vector& v) { return v.segment(block.first, block.size()); };
    const Vector force = own(external);
    const double left = (own(internal) + force).stableNorm();
    double granted = 0;
    if (block.kernel.cols() > 0) {
      granted = kRoundings * std::numeric_limits<double>::epsilon() * moved_forces(block, own(state.u.here()));
      result.resultants = std::max(result.resultants, unbalanced(block, force, std::max(own(gross).sum(), m.force(part))));
    }
    if (std::min(left, granted) > greatest) greatest = std::min(left, granted), result.most = static_cast<int>(b);
    beyond[part] = std::hypot(beyond[part], std::max(0.0, left - granted));
  }
  result.beyond = greatest_ratio(beyond, [&](std::size_t p) { return m.force(p); });
  return result;
}

namespace {

/// By row, what rounding may leave of x = Bu − c: a body that moves as a whole far more than it deforms has no better gaps.
Vector rounding_of_jumps(const Problem& problem, const Displacement& u) {
  constexpr double kRoundings = 16;  // of the terms, which a method sums as well
  const Problem::NearRows near = problem.near_rows();
  const Vector moved = u.there() ? u.there()->some(near.unknowns) : Vector(u.here()(near.unknowns));
  return kRoundings * std::numeric_limits<double>::epsilon() * (algebra::SparseRows(near.B.cwiseAbs()) * moved.cwiseAbs());
}

/// Sets what Residual says of the laws.
void add_laws(const Problem& problem, const State& state, const Vector& x, const Measure& m, Residual& result) {
  const auto rho = [&](int r) { return m.force_of_row(r) / m.length_of_row(r); };
  const Vector rounding = rounding_of_jumps(problem, state.u);
  const Vector off = distances(problem, x, state.lambda, rho, [&](int r) { return rounding[r]; });
  for (int r = 0; r < problem.rows(); ++r) result.law = std::max(result.law, off[r] / m.force_of_row(r));
  std::vector<double> work(static_cast<std::size_t>(m.parts().count), 0);
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    if (!law.unilateral()) continue;
    result.penetration = std::max(result.penetration, (x[r] - rounding[r]) / m.length_of_row(r));
    const auto part = static_cast<std::size_t>(m.parts().of_row[r]);
    work[part] += std::abs(state.lambda[r]) * std::clamp(std::abs(x[r]) - rounding[r], 0.0, m.length(part));
  }
  result.complementarity = greatest_ratio(work, [&](std::size_t p) { return m.force(p) * m.length(p); });
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    const double beyond = state.lambda.segment(first, group.components).norm() - group.bound(k, state.lambda);
    result.friction = std::max(result.friction, beyond / m.force_of_row(first));
  }
}

}  // namespace

Residual residual(const Problem& problem, const State& state) {
  Residual result;
  const Forces all = forces(problem, state);
  const Measure m(problem, state, all);
  const Vector x = jumps(problem, state.u);
  result.energy = energy(problem, all, x);
  algebra::Field left = *all.internal;
  left.set_some(all.unknowns, left.some(all.unknowns) + all.contact);
  if (all.load) left.add(-1, *all.load);
  result.equilibrium = greatest_ratio(OfParts(problem, m.parts()).norm(left), [&](std::size_t p) { return m.force(p); });
  add_laws(problem, state, x, m, result);
  return result;
}

double distance_from_laws(const Problem& problem, const State& state) {
  Residual result;
  add_laws(problem, state, jumps(problem, state.u), Measure(problem, state), result);
  return result.laws();
}

double rounding_of_equilibrium(const Problem& problem, const State& state) {
  const Measure m(problem, state);
  double most = 0;
  for (int p = 0; p < m.parts().count; ++p) most = std::max(most, m.gross_forces(problem, p, state.u) / m.force(p));
  return std::numeric_limits<double>::epsilon() * most;
}

Vector rounding_of_forces(const Problem& problem, const State& state) {
  if (problem.rows() == 0) return {};
  Vector gross(state.u.size());
  for (const Block& block : problem.blocks) gross.segment(block.first, block.size()) = block.K.gross_times(state.u.here().segment(block.first, block.size()));
  Vector rounding = std::numeric_limits<double>::epsilon() * (algebra::SparseRows(problem.B.cwiseAbs()) * gross);
  for (int r = 0; r < problem.rows(); ++r)
    if (const double square = problem.B.row(r).squaredNorm(); square > 0) rounding[r] /= square;
  const Vector x = jumps(problem, state.u);
  const Measure m(problem, state);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r)
      if (-x[r] > 1e-6 * m.length_of_row(r)) rounding[r] = 0;
  return rounding;
}

std::string describe(const Residual& r) {
  return text(std::setprecision(3), "equilibrium ", r.equilibrium, ", penetration ", r.penetration, ", complementarity ", r.complementarity,
              ", friction ", r.friction, ", law ", r.law);
}

}  // namespace dotyk::problem

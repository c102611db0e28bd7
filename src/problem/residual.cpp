#include "problem/residual.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "base/text.hpp"
#include "problem/parts.hpp"

namespace dotyk::problem {

using algebra::Vector;

namespace {

/// By row the distance |λ − P(λ + ρx)|, ρ as `rho` says of it; of a friction point at its first row, ρ as `rho_of_point` says.
template <class RowRho, class PointRho>
Vector distances(const Problem& problem, const Vector& x, const Vector& lambda, const RowRho& rho, const PointRho& rho_of_point) {
  Vector d = Vector::Zero(lambda.size());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      d[r] = std::abs(lambda[r] - group.law->project(r - group.first, lambda[r] + rho(r) * x[r], rho(r)).lambda);
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int r = group.row(k);
      const auto own = lambda.segment(r, group.components);
      const Vector y = own + rho_of_point(group, k) * x.segment(r, group.components);
      d[r] = (own - disc_factor(y.norm(), group.bound(k, lambda)) * y).norm();
    }
  return d;
}

}  // namespace

Vector distances_from_laws(const Problem& problem, const Vector& x, const Vector& lambda, const Vector& rho) {
  return distances(problem, x, lambda, [&](int r) { return rho[r]; }, [&](const FrictionGroup& group, int k) { return rho[group.scale_row(k)]; });
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

/// Forces of a state, and what the parts are measured by.
struct Measured {
  Measured(const Problem& problem, const State& state, Forces all)
      : forces(std::move(all)), parts(problem::parts(problem)), sizes(problem::sizes(problem, state, forces, parts)) {}

  Forces forces;
  Parts parts;
  std::vector<Sizes> sizes;  ///< by part
};

/// The greatest of all parts' numbers relative to their scales, of those that have one.
template <class Scale>
double greatest_ratio(const std::vector<double>& of_part, const Scale& scale) {
  double most = 0;
  for (std::size_t p = 0; p < of_part.size(); ++p)
    if (const double size = scale(p); size > 0) most = std::max(most, of_part[p] / size);
  return most;
}

/// By part the norm of what `of` makes of its blocks.
template <class Of>
std::vector<double> norms(const Problem& problem, const Parts& parts, const Of& of) {
  std::vector<double> norm(parts.count, 0);
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) add(norm[parts.of_block[b]], of(problem.blocks[b]));
  return norm;
}

/// Of each part the greatest excess of a friction force over its bound, relative to the greatest bound; the greatest of all parts.
double friction_violation(const Problem& problem, const State& state, const Parts& parts) {
  std::vector<double> excess(parts.count, 0), largest(parts.count, 0);
  for (const FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const double bound = group.bound(k, state.lambda);
      const int part = parts.of_row[group.row(k)];
      excess[part] = std::max(excess[part], state.lambda.segment(group.row(k), group.components).norm() - bound);
      largest[part] = std::max(largest[part], bound);
    }
  return greatest_ratio(excess, [&](std::size_t p) { return largest[p] > 0 ? largest[p] : 1; });
}

/// ‖|K||w|‖, w the part of u in the block's kernel.
double moved_forces(const Block& block, const Vector& u) {
  const algebra::DenseMatrix& R = block.kernel;
  return block.K.gross_times(R * algebra::least_squares(R, u)).stableNorm();
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
  const Measured m(problem, state, forces(problem, state));
  const Vector internal = m.forces.internal->get(), load = m.forces.load ? m.forces.load->get() : Vector(Vector::Zero(problem.unknowns())),
               external = problem.B.transpose() * state.lambda - load, gross = algebra::SparseRows(problem.B.cwiseAbs()).transpose() * state.lambda.cwiseAbs() + load.cwiseAbs();
  std::vector<double> beyond(m.sizes.size(), 0);
  MotionResidual result;
  double greatest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const int part = m.parts.of_block[b];
    const auto own = [&](const Vector& v) { return v.segment(block.first, block.size()); };
    const Vector force = own(external);
    const double left = (own(internal) + force).stableNorm();
    double granted = 0;
    if (block.kernel.cols() > 0) {
      granted = kRoundings * std::numeric_limits<double>::epsilon() * moved_forces(block, own(state.u.here()));
      result.resultants = std::max(result.resultants, unbalanced(block, force, std::max(own(gross).sum(), m.sizes[part].least_force)));
    }
    if (std::min(left, granted) > greatest) greatest = std::min(left, granted), result.most = static_cast<int>(b);
    beyond[part] = std::hypot(beyond[part], std::max(0.0, left - granted));
  }
  result.beyond = greatest_ratio(beyond, [&](std::size_t p) { return m.sizes[p].force(); });
  return result;
}

namespace {

/// A tenth of what the greatest multiplier of each part would move its stiffest row by. Where loads meet their reactions at the contact itself nothing
/// moves but by rounding: this is the least scale, and a small part of it is as small a part of the forces.
std::vector<double> yielding(const Problem& problem, const State& state, const Parts& parts) {
  std::vector<double> force = parts.greatest(state.lambda);
  const std::vector<double> stiffest = parts.greatest(problem.row_stiffness());
  for (std::size_t p = 0; p < force.size(); ++p) force[p] *= stiffest[p] > 0 ? 0.1 / stiffest[p] : 0;
  return force;
}

/// `Bu`: of the state.
std::vector<Scales> scales(const Problem& problem, const State& state, const Vector& Bu, const Measured& m) {
  std::vector<Scales> of_part(m.sizes.size());
  const std::vector<double> forces = m.parts.greatest(state.lambda), jumps = m.parts.greatest(Bu),
                            least = yielding(problem, state, m.parts);
  for (std::size_t p = 0; p < of_part.size(); ++p) {
    const Sizes& part = m.sizes[p];
    if (const double force = std::max({forces[p], part.greatest_load, part.least_force}); force > 0) of_part[p].force = force;
    if (const double length = std::max({jumps[p], part.greatest_displacement, part.least_length, least[p]}); length > 0) of_part[p].length = length;
  }
  std::vector<Scales> of_row;
  for (const int p : m.parts.of_row) of_row.push_back(of_part[p]);
  return of_row;
}

/// Σ|λ x| over the unilateral rows of a part against its work; the greatest of all parts.
double complementarity(const Problem& problem, const State& state, const Vector& x, const Measured& m) {
  const Parts& parts = m.parts;
  const std::vector<double> least = yielding(problem, state, parts);
  std::vector<double> product(m.sizes.size(), 0), work = product;
  for (std::size_t p = 0; p < work.size(); ++p) work[p] = m.sizes[p].least_work;
  for (int r = 0; r < problem.rows(); ++r) work[parts.of_row[r]] += std::abs(state.lambda[r]) * least[parts.of_row[r]];
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r) {
      product[parts.of_row[r]] += std::abs(state.lambda[r] * x[r]);
      work[parts.of_row[r]] += std::abs(state.lambda[r] * problem.c[r]);
    }
  const OfParts of(problem, parts);
  const std::vector<double> internal = of.dot(*m.forces.u, *m.forces.internal),
                            external = m.forces.load ? of.dot(*m.forces.u, *m.forces.load) : std::vector<double>(work.size(), 0);
  for (std::size_t p = 0; p < work.size(); ++p) work[p] += std::abs(0.5 * internal[p]) + std::abs(external[p]);
  const std::vector<double> beside_others = least_beside_others(work, any_loaded(m.sizes));
  return greatest_ratio(product, [&](std::size_t p) { return m.sizes[p].load > 0 ? work[p] : std::max(work[p], beside_others[p]); });
}

/// Sets Residual::penetration and law.
void add_laws(const Problem& problem, const State& state, const Vector& x, const std::vector<Scales>& scale, Residual& result) {
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r)
      result.penetration = std::max(result.penetration, x[r] / std::max(scale[r].length, std::abs(problem.c[r])));
  const auto rho = [&](int r, double gap) { return scale[r].force / std::max(scale[r].length, gap); };
  const Vector off = distances(
      problem, x, state.lambda, [&](int r) { return rho(r, std::abs(problem.c[r])); },
      [&](const FrictionGroup& group, int k) {
        return rho(group.row(k), problem.c.segment(group.row(k), group.components).lpNorm<Eigen::Infinity>());
      });
  for (int r = 0; r < problem.rows(); ++r) result.law = std::max(result.law, off[r] / scale[r].force);
}

}  // namespace

std::vector<Scales> scales(const Problem& problem, const State& state) {
  return scales(problem, state, rows_times(problem, state.u), Measured(problem, state, external_forces(problem, state)));
}

Residual residual(const Problem& problem, const State& state) {
  Residual result;
  const Measured m(problem, state, forces(problem, state));
  const Vector Bu = rows_times(problem, state.u), x = Bu - problem.c;
  result.energy = energy(problem, m.forces, x);
  algebra::Field left = *m.forces.internal;
  left.set_some(m.forces.unknowns, left.some(m.forces.unknowns) + m.forces.contact);
  if (m.forces.load) left.add(-1, *m.forces.load);
  result.equilibrium = greatest_ratio(OfParts(problem, m.parts).norm(left), [&](std::size_t p) { return m.sizes[p].force(); });
  if (problem.rows() == 0) return result;
  add_laws(problem, state, x, scales(problem, state, Bu, m), result);
  result.complementarity = complementarity(problem, state, x, m);
  result.friction = friction_violation(problem, state, m.parts);
  return result;
}

double distance_from_laws(const Problem& problem, const State& state) {
  Residual result;
  if (problem.rows() > 0) add_laws(problem, state, jumps(problem, state.u), scales(problem, state), result);
  return result.laws();
}

double rounding_of_equilibrium(const Problem& problem, const State& state) {
  const Measured m(problem, state, forces(problem, state));
  const auto gross = norms(problem, m.parts, [&](const Block& block) { return block.K.gross_times(state.u.here().segment(block.first, block.size())); });
  return std::numeric_limits<double>::epsilon() *
         greatest_ratio(gross, [&](std::size_t p) { return m.sizes[p].internal + m.sizes[p].contact + m.sizes[p].load; });
}

Vector rounding_of_forces(const Problem& problem, const State& state) {
  if (problem.rows() == 0) return {};
  Vector gross(state.u.size());
  for (const Block& block : problem.blocks) gross.segment(block.first, block.size()) = block.K.gross_times(state.u.here().segment(block.first, block.size()));
  Vector rounding = std::numeric_limits<double>::epsilon() * (algebra::SparseRows(problem.B.cwiseAbs()) * gross);
  for (int r = 0; r < problem.rows(); ++r)
    if (const double square = problem.B.row(r).squaredNorm(); square > 0) rounding[r] /= square;
  const Vector x = jumps(problem, state.u);
  const std::vector<Scales> scale = scales(problem, state);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; group.law->unilateral() && r < group.first + group.count; ++r)
      if (-x[r] > 1e-6 * scale[r].length) rounding[r] = 0;
  return rounding;
}

std::string describe(const Residual& r) {
  return text(std::setprecision(3), "equilibrium ", r.equilibrium, ", penetration ", r.penetration, ", complementarity ", r.complementarity,
              ", friction ", r.friction, ", law ", r.law);
}

}  // namespace dotyk::problem

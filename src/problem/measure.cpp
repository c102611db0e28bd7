#include "problem/measure.hpp"

#include "problem/condensed.hpp"
#include "problem/rigid_motions.hpp"

namespace dotyk::problem {

using algebra::Vector;

namespace {

/// A part without loads has so much of the greatest force of the others: what methods that treat all parts at once leave there by rounding.
constexpr double kBesideOthers = 1e-4;

/// So many displacements away a row never closes.
constexpr double kNever = 1e6;

const double kHalf = std::sqrt(std::numeric_limits<double>::epsilon());

double positive_or_one(double value) { return value > 0 && std::isfinite(value) ? value : 1; }

/// 1 / w, 0 where w is none or the rounding of one.
Vector local_stiffness(const Vector& w) {
  const double least = w.size() > 0 ? 1e-14 * w.maxCoeff() : 0;
  return w.unaryExpr([&](double yields) { return yields > least ? 1 / yields : 0.0; });
}

/// By part the greatest |u − R R⁺u|, R each block's rigid motions.
std::vector<double> deformation(const Problem& problem, const Parts& parts, const State& state, const Forces& forces) {
  const auto moves = [](const Block& block) { return block.kernel.cols() > 0; };
  if (std::none_of(problem.blocks.begin(), problem.blocks.end(), moves)) return OfParts(problem, parts).greatest(*forces.u);
  std::vector<double> most(static_cast<std::size_t>(parts.count), 0);
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    Vector own = state.u.here().segment(block.first, block.size());
    if (moves(block)) own -= rigid_part(block, own);
    double& of_part = most[static_cast<std::size_t>(parts.of_block[b])];
    of_part = std::max(of_part, own.lpNorm<Eigen::Infinity>());
  }
  return most;
}

}  // namespace

Measure::Measure(const Problem& problem, Vector stiffness)
    : parts_(problem::parts(problem)), stiffness_(stiffness.size() > 0 ? std::move(stiffness) : problem.row_stiffness()),
      c_(problem.c), stiffest_(parts_.greatest(stiffness_)), load_(static_cast<std::size_t>(parts_.count), 0), at_rest_(load_), moved_(load_) {
  take_loads(problem);
  take_rows(problem);
  count_others();
  for (std::size_t p = 0; p < load_.size(); ++p) force_.push_back(std::max(driving(p), least_[p]));
  for (std::size_t p = 0; p < load_.size(); ++p) length_.push_back(stiffest_[p] > 0 ? force_[p] / stiffest_[p] : 0);
  const double most = positive_or_one(std::ranges::max(stiffest_));
  for (double& k : stiffness_) k = k > 0 ? k : most;
  for (double& force : force_) force = positive_or_one(force);
}

Measure::Measure(const Problem& problem, const CondensedProblem& condensed) : Measure(problem, local_stiffness(condensed.W().diagonal())) {}

Measure::Measure(const Problem& problem, const State& state, const Forces& forces) : Measure(problem) {
  const std::vector<double> borne = parts_.norm(state.lambda), deformed = deformation(problem, parts_, state, forces);
  for (std::size_t p = 0; p < force_.size(); ++p) {
    force_[p] = force(p, borne[p]);
    if (force_[p] == 0) force_[p] = std::max(borne[p], kHalf * gross_forces(problem, p, state.u));
    length_[p] = positive_or_one(std::max(stiffest_[p] > 0 ? force_[p] / stiffest_[p] : 0, deformed[p]));
    force_[p] = positive_or_one(force_[p]);
  }
}

double Measure::gross_forces(const Problem& problem, std::size_t part, const Displacement& u) const {
  double norm = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    if (const Block& block = problem.blocks[b]; parts_.of_block[b] == static_cast<int>(part)) add(norm, block.K.gross_times(u.here().segment(block.first, block.size())));
  return norm;
}

void Measure::take_loads(const Problem& problem) {
  if (problem.sliced_load != 0) return void(load_ = OfParts(problem, parts_).norm(whole_load(problem)));
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) add(load_[static_cast<std::size_t>(parts_.of_block[b])], problem.blocks[b].f);
}

void Measure::take_rows(const Problem& problem) {
  Vector at_rest = Vector::Zero(problem.rows());
  const auto pulled = [&](int r) { return std::isfinite(problem.c[r]) ? -stiffness_[r] * problem.c[r] : -std::numeric_limits<double>::max(); };
  for (const auto& [law, k, r] : problem.scalar_rows()) at_rest[r] = law.project(k, pulled(r), stiffness_[r]).lambda;
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    const double bound = group.law->follows(k) ? std::numeric_limits<double>::infinity() : group.bound(k, at_rest);
    Vector y(group.components);
    for (int i = 0; i < group.components; ++i) y[i] = pulled(first + i);
    at_rest.segment(first, group.components) = disc_factor(y.norm(), bound) * y;
  }
  at_rest_ = parts_.norm(at_rest);
  Vector driven = problem.c;
  for (Eigen::Index r = 0; r < driven.size(); ++r) driven[r] = at_rest[r] != 0 ? driven[r] : 0;
  const std::vector<double> furthest = parts_.greatest(driven);
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    if (const auto p = static_cast<std::size_t>(parts_.of_block[b]); load_[p] == 0 && furthest[p] > 0)
      add(moved_[p], furthest[p] * problem.blocks[b].K.gross_times(Vector::Ones(problem.blocks[b].size())));
}

void Measure::count_others() {
  double greatest = 0;
  for (std::size_t p = 0; p < load_.size(); ++p) greatest = std::max({greatest, kBesideOthers * load_[p], kHalf * at_rest_[p]});
  for (std::size_t p = 0; p < load_.size(); ++p) least_.push_back(load_[p] > 0 ? kHalf * at_rest_[p] : std::max(greatest, kHalf * moved_[p]));
}

double Measure::least_force(std::size_t part) const { return std::max(kHalf * load_[part], least_[part]); }

double Measure::length_of_row(int row) const {
  return std::max(length_[static_cast<std::size_t>(parts_.of_row[row])], std::isfinite(c_[row]) ? std::abs(c_[row]) : 0);
}

Nothing Measure::nothing(double relative, const Vector& lambda, const Vector& x) const {
  const auto counts = [&](int r, double moved) { return std::abs(c_[r]) < kNever * moved; };
  Vector jump = (x + c_).cwiseAbs(), force(x.size());
  for (int r = 0; r < x.size(); ++r) jump[r] = counts(r, jump[r]) ? jump[r] : 0;
  const std::vector<double> borne = parts_.greatest(lambda), moved = parts_.greatest(jump);
  for (int r = 0; r < x.size(); ++r) {
    const auto p = static_cast<std::size_t>(parts_.of_row[r]);
    force[r] = relative * (borne[p] + stiffness_[r] * std::max(moved[p], counts(r, moved[p]) ? std::abs(c_[r]) : 0));
  }
  return {force, force.cwiseQuotient(stiffness_)};
}

}  // namespace dotyk::problem

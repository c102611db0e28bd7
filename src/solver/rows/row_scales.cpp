#include "solver/rows/row_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/rows/natural_map.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kSumRoundings = 128;    // k: of the sums in x, and of the solve that made λ

double greatest(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }

}  // namespace

RowScales::RowScales(const problem::Problem& problem, const problem::CondensedProblem& condensed)
    : condensed_(&condensed), c_(problem.c), stiffness_(stiffness_of_rows(condensed)), parts_(problem::parts(problem)),
      least_(static_cast<std::size_t>(parts_.count), 0) {
  for (std::size_t b = 0; b < problem.blocks.size(); ++b)
    least_[parts_.of_block[b]] = std::max(least_[parts_.of_block[b]], greatest(problem.blocks[b].f));
  std::vector<double> driving = parts_.greatest(stiffness_.cwiseProduct(condensed.x0()));
  for (std::size_t p = 0; p < least_.size(); ++p)
    if (least_[p] > 0) driving[p] = least_[p];
  const bool loaded = *std::max_element(least_.begin(), least_.end()) > 0;
  const std::vector<double> beside_others = problem::least_beside_others(driving, loaded);
  const double half = std::sqrt(kEps), of_others = loaded ? 1 : half;
  for (std::size_t p = 0; p < least_.size(); ++p)
    least_[p] = least_[p] > 0 ? half * least_[p] : std::max(half * driving[p], of_others * beside_others[p]);
}

Vector RowScales::forces(const Vector& lambda) const {
  std::vector<double> of_part(least_.size(), 0);
  for (Eigen::Index r = 0; r < lambda.size(); ++r) of_part[parts_.of_row[r]] += lambda[r] * lambda[r];
  for (std::size_t p = 0; p < least_.size(); ++p) of_part[p] = std::max(std::sqrt(of_part[p]), least_[p]);
  return by_row(of_part);
}

Vector RowScales::rounding(const Vector& alpha, const Vector& x) const {
  const Vector moved = alpha.size() > 0 ? Vector(condensed_->N() * alpha) : Vector::Zero(x.size());
  const auto greatest = [&](const Vector& v) { return by_row(parts_.greatest(v)); };
  return kSumRoundings * kEps * (greatest(condensed_->x0()) + greatest(moved) + greatest(condensed_->x0() + moved - x));
}

Vector RowScales::by_row(const std::vector<double>& of_part) const {
  Vector values(static_cast<Eigen::Index>(parts_.of_row.size()));
  for (Eigen::Index r = 0; r < values.size(); ++r) values[r] = of_part[static_cast<std::size_t>(parts_.of_row[r])];
  return values;
}

Vector RowScales::rho(const Vector& lambda, const Vector& alpha, const Vector& x, double tol) const {
  if (x.size() == 0) return x;
  // Row by row: where one body goes far, others' gaps are known as before. Nor may Wλ and Nα cancel.
  Vector gross = condensed_->x0().cwiseAbs() + condensed_->W().cwiseAbs() * lambda.cwiseAbs();
  if (alpha.size() > 0) gross += condensed_->N().cwiseAbs() * alpha.cwiseAbs();
  const Vector F = forces(lambda);
  const std::vector<double> greatest_force = parts_.greatest(lambda), stiffest = parts_.greatest(stiffness_);
  std::vector<double> moved = parts_.greatest(x + c_);
  for (std::size_t p = 0; p < moved.size(); ++p)
    if (stiffest[p] > 0) moved[p] = std::max(moved[p], greatest_force[p] / stiffest[p]);
  Vector rho = stiffness_;
  for (Eigen::Index r = 0; r < x.size(); ++r) {
    const int part = parts_.of_row[r];
    if (const double length = std::max(moved[part], std::abs(c_[r])); length > 0) rho[r] = std::max(rho[r], greatest_force[part] / length);
    if (const double rounding = kSumRoundings * kEps * gross[r]; rounding > 0) rho[r] = std::min(rho[r], tol * F[r] / rounding);
  }
  return rho;
}

}  // namespace dotyk::solver

#include "solver/row_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/natural_map.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kSumRoundings = 128;    // k: of the sums in x, and of the solve that made λ

double greatest(const Vector& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }

}  // namespace

RowScales::RowScales(const problem::Problem& problem, const problem::CondensedProblem& condensed)
    : condensed_(&condensed), c_(problem.c), stiffness_(stiffness_of_rows(condensed)) {
  for (const problem::Block& block : problem.blocks) load_ = std::max(load_, greatest(block.f));
}

double RowScales::force(const Vector& lambda) const {
  const double least = load_ > 0 ? load_ : greatest(stiffness_.cwiseProduct(condensed_->x0()));
  return std::max(lambda.norm(), std::sqrt(kEps) * least);
}

double RowScales::rounding(const Vector& alpha, const Vector& x) const {
  const Vector moved = alpha.size() > 0 ? Vector(condensed_->N() * alpha) : Vector::Zero(x.size());
  return kSumRoundings * kEps * (greatest(condensed_->x0()) + greatest(moved) + greatest(condensed_->x0() + moved - x));
}

Vector RowScales::rho(const Vector& lambda, const Vector& alpha, const Vector& x, double tol) const {
  if (x.size() == 0) return x;
  // Row by row: where one body goes far, others' gaps are known as before. Nor may Wλ and Nα cancel.
  Vector gross = condensed_->x0().cwiseAbs() + condensed_->W().cwiseAbs() * lambda.cwiseAbs();
  if (alpha.size() > 0) gross += condensed_->N().cwiseAbs() * alpha.cwiseAbs();
  const double F = force(lambda), stiffest = stiffness_.maxCoeff();
  const double X = std::max(greatest(x + c_), stiffest > 0 ? greatest(lambda) / stiffest : 0);
  Vector rho = stiffness_;
  for (Eigen::Index r = 0; r < x.size(); ++r) {
    if (const double length = std::max(X, std::abs(c_[r])); length > 0) rho[r] = std::max(rho[r], greatest(lambda) / length);
    if (const double rounding = kSumRoundings * kEps * gross[r]; rounding > 0) rho[r] = std::min(rho[r], tol * F / rounding);
  }
  return rho;
}

}  // namespace dotyk::solver

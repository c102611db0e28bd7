#include "algebra/direct/condensation.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/dense/generalised_inverse.hpp"

namespace dotyk::algebra {

namespace {

constexpr double kFar = 10, kVanishes = 1e-9;

double farthest(const DenseMatrix& motions) { return motions.size() ? motions.rowwise().norm().maxCoeff() : 0; }

/// A kernel as some unknowns feel it.
struct Felt {
  DenseMatrix basis;   ///< R̂ = R V, orthonormal on these unknowns
  DenseMatrix felt;    ///< V
  DenseMatrix unfelt;  ///< combinations of R that vanish there
  Felt(const DenseMatrix& kernel, const std::vector<int>& unknowns) {
    const SingularFactors svd = singular_factors(kernel(unknowns, Eigen::all));
    const Eigen::Index rank = svd.rank(kVanishes * kernel.lpNorm<Eigen::Infinity>());
    basis = svd.U.leftCols(rank);
    felt = svd.V.leftCols(rank) * svd.values.head(rank).cwiseInverse().asDiagonal();
    unfelt = svd.V.rightCols(kernel.cols() - rank);
  }
};

}  // namespace

std::vector<int> far_unknowns(const DenseMatrix& kernel, const std::vector<int>& unknowns) {
  const Felt here(kernel, unknowns);
  const DenseMatrix felt = kernel * here.felt;
  if (farthest(felt) <= kFar * farthest(here.basis)) return {};
  const Vector unfelt = DenseMatrix(kernel * here.unfelt).rowwise().norm();
  const double vanishes = kVanishes * kernel.lpNorm<Eigen::Infinity>();
  std::vector<char> there(static_cast<std::size_t>(unfelt.size()), 0);
  for (const int i : unknowns) there[i] = 1;
  std::vector<int> candidates, far;
  for (Eigen::Index i = 0; i < unfelt.size(); ++i)
    if (unfelt[i] <= vanishes) candidates.push_back(static_cast<int>(i));
  for (const int k : fixing_unknowns(DenseMatrix(felt(candidates, Eigen::all))))  // Γ's own among the candidates make the columns independent
    if (!there[candidates[k]]) far.push_back(candidates[k]);
  return far;
}

Condensation::Condensation(const SparseMatrix& K, const std::vector<int>& node, const std::vector<int>& last, const DenseMatrix& kernel, Ordering ordering)
    : factor_(K, node, last, ordering, kernel.cols() > 0), kernel_(kernel(boundary(), Eigen::all)) {
  if (kernel_size() == 0) return;
  Felt here(kernel, boundary());
  basis_ = std::move(here.basis), felt_ = std::move(here.felt), unfelt_ = std::move(here.unfelt);
  pinned_ = fixing_unknowns(kernel * unfelt_);
}

bool Condensation::factor(const SparseMatrix& K) {
  if (kernel_size() == 0) {
    if (!factor_.factor(K)) return false;
  } else {
    std::vector<int> place(boundary().size());  // on Γ, of its unknowns in ascending order
    std::iota(place.begin(), place.end(), 0);
    std::sort(place.begin(), place.end(), [&](int a, int b) { return boundary()[a] < boundary()[b]; });
    std::vector<int> unknowns;
    for (const int k : place) unknowns.push_back(boundary()[k]);
    tau_ = 0;
    for (const int unknown : unknowns) tau_ += K.coeff(unknown, unknown) / static_cast<double>(unknowns.size());
    const DenseMatrix R = basis_(place, Eigen::all).transpose();
    SparseMatrix held = with_block(K, unknowns, [&](int i, int j) { return tau_ * R.col(i).dot(R.col(j)); });
    for (const int unknown : pinned_) held.coeffRef(unknown, unknown) *= 2;
    if (!factor_.factor(held)) return false;
  }
  l_gamma_ = factor_.boundary_factor();
  return true;
}

DenseMatrix Condensation::schur() const {
  DenseMatrix S = square(l_gamma_);
  if (kernel_size()) S -= tau_ * basis_ * basis_.transpose();
  return S;
}

Vector Condensation::condense(const Vector& f) {
  swept_ = factor_.forward(f);
  return l_gamma_.triangularView<Eigen::Lower>() * factor_.boundary_part(swept_);
}

Vector Condensation::solve(const Vector& b) const {
  Vector x = b;
  solve_lower(l_gamma_, x);
  solve_lower_transposed(l_gamma_, x);
  return x;
}

DenseMatrix Condensation::half_compliance(const SparseRows& B) const {
  DenseMatrix x = DenseMatrix(B.transpose());
  solve_lower(l_gamma_, x);
  return x;
}

bool Condensation::are_far(const SparseRows& rows, const DenseMatrix& kernel) const {
  if (kernel.cols() == 0 || rows.rows() == 0) return false;
  if (boundary().empty()) return true;
  const DenseMatrix moved = rows * kernel;
  const Vector size = rows.cwiseAbs() * Vector::Ones(rows.cols());
  const double most = kFar * farthest(basis_), least = kVanishes * kernel.lpNorm<Eigen::Infinity>();
  return ((moved * felt_).rowwise().norm().array() > most * size.array()).any() || ((moved * unfelt_).rowwise().norm().array() > least * size.array()).any();
}

Condensation::Further Condensation::further(const ReachedSweep& sweep) const {
  const DenseMatrix swept = sweep.values();
  Further out{gram(swept), factor_.boundary_part(sweep, swept)};
  solve_lower_transposed(l_gamma_, out.on_boundary);
  return out;
}

Vector Condensation::recover(const Vector& boundary_values) const { return from_boundary(swept_, boundary_values); }

Vector Condensation::response(const Vector& f, const Vector& added) const {
  Vector swept = factor_.forward(f);
  const Vector load = l_gamma_.triangularView<Eigen::Lower>() * factor_.boundary_part(swept);
  return from_boundary(std::move(swept), solve(load) + added);
}

Vector Condensation::from_boundary(Vector swept, const Vector& boundary_values) const {
  factor_.set_boundary_part(swept, l_gamma_.transpose().triangularView<Eigen::Upper>() * boundary_values);
  return factor_.backward(swept);
}

}  // namespace dotyk::algebra

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;

/// W_rr is about 1/ρ_r or more. Where it is less than this part of 1/ρ_r, the row acts on unknowns that the generalised inverse fixes.
constexpr double kFixed = 1e-8;

class ReducedStep final : public Step {
 public:
  ReducedStep(const CondensedProblem& condensed, const Vector& rho)
      : condensed_(condensed), rho_(rho), lambda_(Vector::Zero(condensed.rows())),
        alpha_(Vector::Zero(condensed.kernel_size())) {}

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    std::vector<int> active;
    lambda = Vector::Zero(condensed_.rows());
    for (int r = 0; r < condensed_.rows(); ++r)
      if (l.active[r])
        active.push_back(r);
      else
        lambda[r] = l.value[r];
    if (!active.empty() || condensed_.kernel_size() > 0) {
      // (W + C)_AA λ_A − N_A α = (x₀ − W λ_I)_A − offset,  N_Aᵀ λ_A = e − N_Iᵀ λ_I
      const int n = static_cast<int>(active.size());
      DenseMatrix H = condensed_.W()(active, active);
      DenseMatrix N = condensed_.N()(active, Eigen::all);
      Vector g = condensed_.jump(lambda, Vector())(active), unit(n);  // of multipliers: H gets the diagonal 1, or a weak spring's compliance would hide all other rows
      for (int j = 0; j < n; ++j) {
        H(j, j) += l.added_compliance(active[j], rho_[active[j]]);
        g[j] -= l.offset(active[j], rho_[active[j]]);
        unit[j] = 1 / std::sqrt(std::max(H(j, j), kFixed / rho_[active[j]]));
      }
      H = unit.asDiagonal() * H * unit.asDiagonal();
      N = unit.asDiagonal() * N;
      const Vector length = N.colwise().norm().unaryExpr([](double norm) { return norm > 0 ? 1 / norm : 1.0; });
      N = N * length.asDiagonal();
      g = unit.cwiseProduct(g);
      const Vector e = length.cwiseProduct(condensed_.e() - condensed_.N().transpose() * lambda);
      Vector solved;
      if (!solve_definite(H, N, g, e, solved) && !solve_dependent(H, N, g, e, solved)) return false;
      lambda(active) = unit.cwiseProduct(solved);
      alpha_ = length.cwiseProduct(alpha_);
    }
    lambda_ = lambda;
    x = condensed_.jump(lambda, alpha_);
    return true;
  }

  problem::Displacement recover() override { return condensed_.recover(lambda_, alpha_); }

 private:
  bool solve_definite(const DenseMatrix& H, const DenseMatrix& N, const Vector& g, const Vector& e,
                      Vector& lambda) {
    DenseMatrix L = H;
    if (!algebra::cholesky(L)) return false;
    // A pivot this small belongs to a dependent row that rounding let through. A diagonal below 1 belongs to a row that acts on
    // unknowns which the generalised inverse fixes.
    for (int j = 0; j < L.rows(); ++j)
      if (!(L(j, j) * L(j, j) >= 1e-13 && H(j, j) > 0.5)) return false;
    Vector z = g;
    algebra::solve_lower(L, z);
    if (N.cols() > 0) {
      DenseMatrix Y = N;
      algebra::solve_lower(L, Y);
      const DenseMatrix S = algebra::gram(Y);
      const algebra::Ldlt ldlt(S);
      if (!(ldlt.rcond() >= 1e-14)) return false;
      alpha_ = ldlt.solve(Vector(e - Y.transpose() * z));
      z += Y * alpha_;
    }
    algebra::solve_lower_transposed(L, z);
    lambda = z;
    return true;
  }

  /// Dependent active rows (two conditions on one component): the multipliers of least norm Σ H_jj λ_j²,
  /// if the conditions agree with each other.
  bool solve_dependent(const DenseMatrix& H, const DenseMatrix& N, const Vector& g, const Vector& e,
                       Vector& lambda) {
    const int n = static_cast<int>(H.rows()), k = static_cast<int>(N.cols());
    DenseMatrix A = DenseMatrix::Zero(n + k, n + k);
    A.topLeftCorner(n, n) = H;
    A.topRightCorner(n, k) = -N;
    A.bottomLeftCorner(k, n) = N.transpose();
    Vector b(n + k);
    b << g, e;
    const Vector y = algebra::MinimumNorm(A, 1e-11).solve(b);
    if (!y.allFinite() || (A * y - b).norm() > 1e-8 * b.norm()) return false;
    lambda = y.head(n);
    alpha_ = y.tail(k);
    return true;
  }

  const CondensedProblem& condensed_;
  const Vector& rho_;
  Vector lambda_, alpha_;
};

}  // namespace

std::unique_ptr<Step> reduced_step(const CondensedProblem& condensed, const Vector& rho) {
  return std::make_unique<ReducedStep>(condensed, rho);
}

}  // namespace dotyk::solver

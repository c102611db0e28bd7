#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;

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
      const DenseMatrix N = condensed_.N()(active, Eigen::all);
      Vector g = condensed_.jump(lambda, Vector())(active);
      for (int j = 0; j < n; ++j) {
        H(j, j) += l.added_compliance(active[j], rho_[active[j]]);
        g[j] -= l.offset(active[j], rho_[active[j]]);
      }
      const Vector e = condensed_.e() - condensed_.N().transpose() * lambda;
      Vector solved;
      if (!solve_definite(H, N, g, e, solved) && !solve_dependent(H, N, g, e, solved)) return false;
      lambda(active) = solved;
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
    // A pivot this small against the diagonal is a dependent row that rounding let through; a diagonal this small
    // a row on what the generalised inverse fixes.
    const double greatest = H.rows() > 0 ? H.diagonal().maxCoeff() : 0;
    for (int j = 0; j < L.rows(); ++j)
      if (!(L(j, j) * L(j, j) >= 1e-13 * H(j, j) && H(j, j) > 1e-14 * greatest)) return false;
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

  /// Dependent active rows (two conditions on one component): the least-norm multipliers,
  /// if the conditions agree with each other.
  bool solve_dependent(const DenseMatrix& H, const DenseMatrix& N, const Vector& g, const Vector& e,
                       Vector& lambda) {
    const int n = static_cast<int>(H.rows()), k = static_cast<int>(N.cols());
    // Compliances and rigid motions have different units: bring both blocks to the same scale.
    const double h = n > 0 ? H.diagonal().maxCoeff() : 1.0;
    const double s = k > 0 && n > 0 ? h / std::max(N.cwiseAbs().maxCoeff(), 1e-300) : 1.0;
    DenseMatrix A = DenseMatrix::Zero(n + k, n + k);
    A.topLeftCorner(n, n) = H;
    A.topRightCorner(n, k) = -s * N;
    A.bottomLeftCorner(k, n) = s * N.transpose();
    Vector b(n + k);
    b << g, s * e;
    const Vector y = algebra::MinimumNorm(A, 1e-11).solve(b);
    if (!y.allFinite() || (A * y - b).norm() > 1e-8 * b.norm()) return false;
    lambda = y.head(n);
    alpha_ = s * y.tail(k);
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

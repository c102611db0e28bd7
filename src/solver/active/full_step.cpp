#include <vector>

#include "algebra/direct/sparse_lu.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {
namespace {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;

class FullStep final : public Step {
 public:
  FullStep(const Problem& problem, const problem::RigidMotions& rigid, const Vector& rho)
      : problem_(problem), rho_(rho), border_(problem::displacement(problem, rigid.unnoticed)) {
    for (const Block& block : problem.blocks)
      for (int j = 0; j < block.size(); ++j)
        for (SparseMatrix::InnerIterator it(block.K, j); it; ++it) {
          const int row = block.first + static_cast<int>(it.row()), column = block.first + j;
          stiffness_.emplace_back(row, column, it.value());
          if (row != column) stiffness_.emplace_back(column, row, it.value());
        }
    // Multipliers in units of the stiffness: pivots then tell a dependent row from a stiff material.
    double sum = 0;
    for (const auto& entry : stiffness_)
      if (entry.row() == entry.col()) sum += entry.value();
    if (sum > 0) unit_ = sum / problem.unknowns();
    u_ = Vector::Zero(problem.unknowns());
  }

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    const int n = problem_.unknowns(), m = problem_.rows(), k = static_cast<int>(border_.cols());
    // Rows of the laws: (Bu)_r − added_compliance λ_r = c_r + offset, and λ_r = P where D = 0.
    auto entries = stiffness_;
    Vector b = Vector::Zero(n + m + k);
    for (const Block& block : problem_.blocks) b.segment(block.first, block.size()) = block.f;
    for (int r = 0; r < m; ++r) {
      const double slope = l.slope[r];
      for (SparseRows::InnerIterator it(problem_.B, r); it; ++it) {
        const int j = static_cast<int>(it.col());
        entries.emplace_back(j, n + r, unit_ * it.value());
        if (slope > 0) entries.emplace_back(n + r, j, it.value());
      }
      if (slope > 0) {
        entries.emplace_back(n + r, n + r, -unit_ * l.added_compliance(r, rho_[r]));
        b[n + r] = problem_.c[r] + l.offset(r, rho_[r]);
      } else {
        entries.emplace_back(n + r, n + r, 1.0);
        b[n + r] = l.value[r] / unit_;
      }
    }
    for (int j = 0; j < k; ++j)
      for (SparseMatrix::InnerIterator it(border_, j); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), n + m + j, unit_ * it.value());
        entries.emplace_back(n + m + j, static_cast<int>(it.row()), unit_ * it.value());
      }
    SparseMatrix A(n + m + k, n + m + k);
    A.setFromTriplets(entries.begin(), entries.end());
    A.makeCompressed();
    const algebra::SparseLu lu(A);
    if (lu.singular()) return false;
    const Vector y = lu.solve(b);
    if (!y.allFinite()) return false;
    u_ = y.head(n);
    lambda = unit_ * y.segment(n, m);
    x = problem_.B * u_ - problem_.c;
    return true;
  }

  Vector recover() override { return u_; }

 private:
  const Problem& problem_;
  const Vector& rho_;
  std::vector<Eigen::Triplet<double>> stiffness_;
  double unit_ = 1;
  SparseMatrix border_;  ///< displacements that no row notices
  Vector u_;
};

}  // namespace

std::unique_ptr<Step> full_step(const Problem& problem, const problem::RigidMotions& rigid,
                                const Vector& rho) {
  return std::make_unique<FullStep>(problem, rigid, rho);
}

}  // namespace dotyk::solver

#include "solver/programs/penalty_step.hpp"

#include <cmath>

#include "algebra/dense/generalised_inverse.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;

namespace {

/// Stiffness that a row sees, 1 where nothing moves it.
Vector own_stiffness(const Problem& problem) {
  Vector k = problem.row_stiffness();
  for (double& value : k)
    if (!(value > 0)) value = 1;
  return k;
}

class PenaltyStep final : public Step {
 public:
  PenaltyStep(const Problem& problem, const problem::RigidMotions& rigid, Vector stiffness, algebra::Ordering ordering)
      : problem_(problem), spring_(std::move(stiffness)), own_(own_stiffness(problem)), k_(spring_),
        unnoticed_(problem::unnoticed_displacements(problem, rigid)), f_(problem.unknowns()),
        cholesky_(matrix(std::vector<char>(problem.rows(), 1)), problem::nodes(problem), {}, ordering) {
    for (const problem::RowGroup& group : problem.groups)
      for (int r = group.first; r < group.first + group.count; ++r)
        if (!std::isfinite(spring_[r])) k_[r] = *group.law->linear_stiffness(r - group.first);
    for (const Block& block : problem.blocks) f_.segment(block.first, block.size()) = block.f;
  }

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    if (!cholesky_.factor(matrix(l.active))) return false;
    Vector pull = Vector::Zero(problem_.rows());
    for (int r = 0; r < problem_.rows(); ++r)
      if (l.active[r]) pull[r] = k_[r] * problem_.c[r];
    u_ = cholesky_.solve(f_ + problem_.B.transpose() * pull);
    if (!u_.allFinite()) return false;
    u_ = problem::least(unnoticed_, std::move(u_));
    x = problem_.B * u_ - problem_.c;
    lambda = lambda_ = Vector::Zero(problem_.rows());
    for (int r = 0; r < problem_.rows(); ++r) {
      if (!l.active[r]) continue;
      lambda_[r] = k_[r] * x[r];
      if (std::isfinite(spring_[r])) x[r] = 0;  // behind the spring
    }
    lambda = lambda_;
    return true;
  }

  Vector recover() override {
    Vector all(problem_.unknowns() + (spring_.array() < INFINITY).count());
    all.head(problem_.unknowns()) = u_;
    Eigen::Index place = problem_.unknowns();
    for (int r = 0; r < problem_.rows(); ++r)
      if (std::isfinite(spring_[r])) all[place++] = lambda_[r] / std::sqrt(own_[r] * spring_[r]);
    return all;
  }

 private:
  SparseMatrix matrix(const std::vector<char>& active) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int r = 0; r < problem_.rows(); ++r)
      for (SparseRows::InnerIterator i(problem_.B, r); i; ++i)
        for (SparseRows::InnerIterator j(problem_.B, r); j; ++j)
          if (i.col() >= j.col())
            entries.emplace_back(static_cast<int>(i.col()), static_cast<int>(j.col()),
                                 active[r] ? k_[r] * i.value() * j.value() : 0.0);
    SparseMatrix springs(problem_.unknowns(), problem_.unknowns());
    springs.setFromTriplets(entries.begin(), entries.end());
    SparseMatrix lower = problem::lower_stiffness(problem_) + springs;
    // Motions that no row notices are held at as many unknowns: that carries nothing.
    for (int unknown : algebra::fixing_unknowns(unnoticed_)) lower.coeffRef(unknown, unknown) *= 2;
    return lower;
  }

  const Problem& problem_;
  const Vector spring_, own_;
  Vector k_;  ///< of the spring, or of the elastic law
  const algebra::SparseMatrix unnoticed_;
  Vector f_;
  algebra::Cholesky cholesky_;
  Vector u_, lambda_;
};

}  // namespace

Problem with_springs(const Problem& problem, const Vector& stiffness) {
  Problem out = problem;
  const Vector own = own_stiffness(problem);
  std::vector<int> rows;
  for (int r = 0; r < problem.rows(); ++r)
    if (std::isfinite(stiffness[r])) rows.push_back(r);
  const int n = static_cast<int>(rows.size());
  if (n == 0) return out;
  Block springs;
  springs.name = "springs of the contact";
  springs.K.resize(n, n);
  springs.K.setIdentity();
  springs.f = Vector::Zero(n);
  springs.kernel.resize(n, 0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < problem.rows(); ++r)
    for (SparseRows::InnerIterator it(problem.B, r); it; ++it)
      entries.emplace_back(r, static_cast<int>(it.col()), it.value());
  for (int k = 0; k < n; ++k) {
    springs.node.push_back(k);
    springs.K.valuePtr()[k] = own[rows[k]];
    entries.emplace_back(rows[k], problem.unknowns() + k, -std::sqrt(own[rows[k]] / stiffness[rows[k]]));
  }
  problem::add(out, std::move(springs));
  out.B.resize(problem.rows(), out.unknowns());
  out.B.setFromTriplets(entries.begin(), entries.end());
  return out;
}

std::unique_ptr<Step> penalty_step(const Problem& problem, const problem::RigidMotions& rigid, const Vector& stiffness,
                                   algebra::Ordering ordering) {
  return std::make_unique<PenaltyStep>(problem, rigid, stiffness, ordering);
}

}  // namespace dotyk::solver

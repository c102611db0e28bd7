#include "solver/rows/natural_map.hpp"

#include "algebra/dense/dense.hpp"
#include "solver/active/linearisation.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;

NaturalMap::NaturalMap(const Problem& problem, const problem::CondensedProblem& condensed, const Vector& rho)
    : problem_(&problem), condensed_(&condensed), rho_(rho) {
  for (const auto& [group, k, first, n] : problem.friction_points())  // the projection onto a disc needs one ρ
    rho_.segment(first, group.components).setConstant(rho[group.scale_row(k)]);
  root_ = rho_.cwiseSqrt();
  const DenseMatrix N = root_.asDiagonal() * condensed.N();
  if (N.size() == 0) return;
  auto [Q, R] = algebra::orthogonal_factors(N);
  Q_ = std::move(Q), R_ = std::move(R);
}

Vector NaturalMap::alpha(const Vector& a) const {
  return a.size() > 0 ? Vector(R_.triangularView<Eigen::Upper>().solve(a)) : a;
}

Vector NaturalMap::scaled_alpha(const Vector& alpha) const {
  return alpha.size() > 0 ? Vector(R_.triangularView<Eigen::Upper>() * alpha) : alpha;
}

Vector NaturalMap::unbalanced(const Vector& lambda) const {
  const Vector left = condensed_->e() - condensed_->N().transpose() * lambda;
  return left.size() > 0 ? Vector(R_.triangularView<Eigen::Upper>().transpose().solve(left)) : left;
}

Vector NaturalMap::balancing(const Vector& unbalanced) const {
  return unbalanced.size() > 0 ? Vector(root_.cwiseProduct(Q_ * unbalanced)) : Vector::Zero(root_.size());
}

double NaturalMap::greatest_compliance() const {
  if (root_.size() == 0) return 0;
  const double of_W = (condensed_->W().cwiseAbs() * root_).cwiseProduct(root_).maxCoeff();
  return of_W + (condensed_->kernel_size() > 0 ? 1 : 0);
}

int NaturalMap::Value::differences(const Value& other) const {
  int count = 0;
  for (std::size_t r = 0; r < piece.size(); ++r) count += piece[r] != other.piece[r];
  return count;
}

NaturalMap::Value NaturalMap::with_jump(const Iterate& from, Vector x) const {
  const int m = problem_->rows();
  const Vector& lambda = from.lambda;
  Value v;
  v.from = from;
  v.projected = Vector::Zero(m);
  v.x = std::move(x);
  v.y = lambda + rho_.cwiseProduct(v.x);
  v.closed.assign(m, 0);
  v.slipping.assign(m, 0);
  v.piece.assign(m, 0);
  Vector slope = Vector::Zero(m);
  for (const auto& [law, k, r] : problem_->scalar_rows()) {
    const problem::Projection p = law.project(k, v.y[r], rho_[r]);
    v.projected[r] = p.lambda;
    slope[r] = p.slope;
    if (p.slope == 0) continue;
    v.slope.emplace_back(r, r, p.slope);
    v.closed[r] = 1;
    v.piece[r] = p.lambda < 0 && problem::kinked_at_zero(law, k) ? 2 : 1;
    ++v.active;
  }
  for (const auto& [group, k, first, n] : problem_->friction_points()) {
    const int d = group.components;
    const double bound = group.bound(k, v.projected);
    if (bound == 0) continue;  // open, or without friction here
    const problem::DiscProjection p = problem::project_disc(v.y.segment(first, d), bound);
    v.projected.segment(first, d) = p.value;
    for (int i = 0; i < d; ++i) {
      for (int j = 0; j < d; ++j)
        if (p.slope(i, j) != 0) v.slope.emplace_back(first + i, first + j, p.slope(i, j));
      const double by_normal = n < 0 ? 0 : p.by_bound[i] * group.law->bound_slope(k) * slope[n];
      if (by_normal != 0) v.slope.emplace_back(first + i, n, by_normal);
      v.piece[first + i] = p.stick ? 1 : 2;
      v.slipping[first + i] = !p.stick;
    }
    ++(p.stick ? v.stick : v.slip);
  }
  const Vector unbalanced = condensed_->e() - condensed_->N().transpose() * lambda;
  v.norm = std::sqrt((lambda - v.projected).squaredNorm() + unbalanced.squaredNorm());
  v.scaled_norm = (lambda - v.projected).cwiseQuotient(root_).norm();
  v.unbalanced = this->unbalanced(lambda);
  return v;
}

NaturalMap::Value NaturalMap::sticking(const std::vector<char>& start) const {
  const int m = problem_->rows();
  Value v = at(Vector::Zero(m), Vector::Zero(condensed_->kernel_size()));
  const std::vector<char> closed = first_active(*problem_, start);
  std::vector<char> scalar(m, 0);
  for (const auto& [law, k, r] : problem_->scalar_rows()) scalar[r] = !law.unilateral() && closed[r];
  std::erase_if(v.slope, [&](const auto& t) { return !scalar[t.row()]; });
  for (int r = 0; r < m; ++r) {
    if (scalar[r]) continue;
    v.projected[r] = v.y[r] = 0;  // x' = 0 where closed, λ' = 0 elsewhere
    if (closed[r]) v.slope.emplace_back(r, r, 1.0);
  }
  return v;
}

NaturalMap::System NaturalMap::linearise(const Value& v) const {
  const int m = problem_->rows();
  SparseRows S(m, m);
  S.setFromTriplets(v.slope.begin(), v.slope.end());
  System system;
  std::vector<int> place(m, -1);
  for (int r = 0; r < m; ++r)
    if (S.outerIndexPtr()[r + 1] > S.outerIndexPtr()[r]) {
      place[r] = static_cast<int>(system.rows.size());
      system.rows.push_back(r);
    }
  const bool rest = v.from.lambda.size() == 0;
  system.from = rest ? Iterate{Vector::Zero(m), Vector::Zero(condensed_->kernel_size())} : v.from;
  system.motion = scaled_alpha(system.from.alpha);
  const Vector x = rest ? condensed_->jump(system.from.lambda, system.from.alpha) : v.x;
  system.fixed = v.projected - system.from.lambda;
  for (int r : system.rows) system.fixed[r] = 0;
  const Eigen::Index n = static_cast<Eigen::Index>(system.rows.size()), k = condensed_->kernel_size();
  system.matrix = DenseMatrix::Zero(n + k, n + k);
  system.right_side = Vector::Zero(n + k);
  // With d and δ the changes of λ and α: d = projected − λ + S (d + ρ(−W d + N δ) + λ + ρx − y), divided by √ρ.
  DenseMatrix& matrix = system.matrix;
  const SparseRows own = algebra::pick_rows(S, system.rows);
  const SparseRows scaled = own * root_.asDiagonal();  // S D^{1/2}
  for (Eigen::Index j = 0; j < n; ++j) {
    const int c = system.rows[j];
    matrix.col(j).head(n).noalias() = scaled * (root_[c] * condensed_->W().col(c));
    matrix(j, j) += 1;
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (SparseRows::InnerIterator it(own, i); it; ++it)
      if (place[it.col()] >= 0) matrix(i, place[it.col()]) -= it.value();
  const Vector off = system.from.lambda + rho_.cwiseProduct(x) - v.y;
  const Vector lacking = (system.fixed + off).cwiseQuotient(root_) - root_.cwiseProduct(condensed_->W() * system.fixed);
  system.right_side.head(n) = (v.projected - system.from.lambda)(system.rows).cwiseQuotient(root_(system.rows)) + own * lacking;
  if (k > 0) {
    matrix.topRightCorner(n, k).noalias() = -(own * Q_);
    matrix.bottomLeftCorner(k, n) = Q_(system.rows, Eigen::all).transpose();
  }
  system.right_side.tail(k) = unbalanced(system.from.lambda + system.fixed);
  return system;
}

void NaturalMap::System::hold(double spring, const Vector& anchor) {
  matrix.diagonal().tail(anchor.size()).array() += spring;
  right_side.tail(anchor.size()) += spring * (anchor - motion);
}

Iterate NaturalMap::take(const System& system, const Vector& solved) const {
  Iterate to{system.from.lambda + system.fixed, system.from.alpha + alpha(solved.tail(condensed_->kernel_size()))};
  for (std::size_t i = 0; i < system.rows.size(); ++i)
    to.lambda[system.rows[i]] += solved[static_cast<Eigen::Index>(i)] * root_[system.rows[i]];
  return to;
}

Vector NaturalMap::solved(const System& system, const algebra::Lu& lu, double least) {
  constexpr int kMost = 1500;  // rows: beyond, a step is more work than many of the fixed point iteration
  constexpr double kRank = 1e-11;
  if (!singular(least)) return lu.solve(system.right_side);
  if (system.matrix.rows() > kMost) return Vector::Constant(system.matrix.rows(), NAN);
  return algebra::MinimumNorm(system.matrix, kRank).solve(system.right_side);
}

}  // namespace dotyk::solver

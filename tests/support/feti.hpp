#pragma once

#include <algorithm>

#include "scenes.hpp"
#include "solver/feti/feti.hpp"

namespace dotyk::test {

inline solver::Feti feti(int count, bool support_rows = true,
                         solver::Feti::Preconditioner preconditioner = solver::Feti::Preconditioner::none) {
  solver::Feti method;
  method.tol = 1e-11;
  method.max_iterations = 500;
  method.decomposition.count = count;
  method.decomposition.support_rows = support_rows;
  method.preconditioner = preconditioner;
  return method;
}

inline std::shared_ptr<scene::Solution> solve_by(const std::shared_ptr<scene::Scene>& s, const solver::Method& method) {
  Monitor quiet;
  return scene::solve(s, method, {}, quiet);
}

/// How far a body is from equilibrium, relative to the forces on it.
struct Imbalance {
  double nodal = 0;      ///< ‖Ku + Bᵀλ − f‖ / (‖Ku‖ + ‖Bᵀλ‖ + ‖f‖)
  double resultant = 0;  ///< greatest |rᵀ(f − Bᵀλ)| / (|r|ᵀ(|f| + |Bᵀλ|)) over the motions r that its supports leave it
};

inline Imbalance imbalance(const scene::Solution& s, int body) {
  const problem::Problem& p = s.model().problem;
  const problem::Block& b = p.blocks[body];
  const algebra::Vector u = s.result().state.u.here().segment(b.first, b.size());
  const algebra::Vector contact = algebra::SparseRows(p.rows_of(b)).transpose() * s.result().state.lambda;
  const algebra::Vector elastic = b.K.lower().selfadjointView<Eigen::Lower>() * u, left = b.f - contact;
  Imbalance worst;
  const double size = elastic.norm() + contact.norm() + b.f.norm();
  if (size > 0) worst.nodal = (left - elastic).norm() / size;
  for (Eigen::Index j = 0; j < b.kernel.cols(); ++j) {
    const double parts = b.kernel.col(j).cwiseAbs().dot(algebra::Vector(b.f.cwiseAbs() + contact.cwiseAbs()));
    if (parts > 0) worst.resultant = std::max(worst.resultant, std::abs(b.kernel.col(j).dot(left)) / parts);
  }
  return worst;
}

}  // namespace dotyk::test

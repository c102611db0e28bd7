// The linear solvers of HeldStiffness.
#include <algorithm>
#include <utility>

#include "multigrid/multigrid.hpp"
#include "problem/coarser.hpp"
#include "solver/active/held_stiffness.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Field;
using algebra::SparseMatrix;
using algebra::StoredMatrix;
using algebra::Vector;
using problem::Problem;

namespace {

/// The rigid motions of all bodies moving as one, by the last of these functions. No columns if a block has no function `rigid`.
DenseMatrix all_rigid_motions(const Problem& problem, const std::vector<algebra::CoarseFunctions>& coarse) {
  const auto levels = static_cast<int>(coarse.size());
  const bool told = levels > 0 && std::ranges::all_of(problem.blocks, [](const problem::Block& block) { return bool(block.coarse.rigid); });
  DenseMatrix all(told ? coarse.back().columns : problem.unknowns(), 0);
  Eigen::Index first = 0;
  for (const problem::Block& block : problem.blocks) {
    if (!block.rigid) return DenseMatrix(all.rows(), 0);
    const DenseMatrix own = told ? block.coarse.rigid(levels) : block.rigid();
    if (all.cols() == 0) all.setZero(all.rows(), own.cols());
    all.middleRows(first, own.rows()) = own;
    first += own.rows();
  }
  for (const algebra::CoarseFunctions& functions : coarse)
    if (!told) all = functions.at_coarse(all);
  return all;
}

/// Solves with TᵀKT, T of signs, by a solver for K.
class SignedSolver final : public algebra::SpdSolver {
 public:
  /// `near`: all unknowns with other signs than +1, which are watched in fields.
  SignedSolver(const Vector& signs, const std::vector<int>& near, std::unique_ptr<algebra::SpdSolver> of_K) : signs_(signs), near_signs_(signs(near)), of_K_(std::move(of_K)) {}

  /// Entries of K from such of TᵀKT.
  static algebra::Triplets of_K(const algebra::Triplets& entries, const Vector& signs) {
    algebra::Triplets all;
    for (const auto& e : entries) all.emplace_back(e.row(), e.col(), signs[e.row()] * signs[e.col()] * e.value());
    return all;
  }

  bool set(const algebra::Triplets& changed, const std::vector<char>& held) override { return of_K_->set(of_K(changed, signs_), held); }
  Vector solve(const Vector& b, double tolerance, Vector* left) override {
    const Vector x = of_K_->solve(signs_.cwiseProduct(b), tolerance, left);
    if (left) left->array() *= signs_.array();
    return signs_.cwiseProduct(x);
  }
  Solved solve_fields(Field& b, double tolerance, Field& x, Field& left) override {
    turn(b);
    const Solved solved = of_K_->solve_fields(b, tolerance, x, left);
    for (Field* field : {&b, &x, &left}) turn(*field);
    return solved;
  }
  bool interpolate(const Field& coarse, Field& fine) const override {
    if (!of_K_->interpolate(coarse, fine)) return false;
    turn(fine);
    return true;
  }
  bool iterates() const override { return of_K_->iterates(); }
  int iterations() const override { return of_K_->iterations(); }
  int levels() const override { return of_K_->levels(); }
  double bytes() const override { return of_K_->bytes(); }
  std::string method() const override { return of_K_->method(); }

 private:
  void turn(Field& field) const { field.set_watched(near_signs_.cwiseProduct(field.watched())); }

  const Vector signs_, near_signs_;
  const std::unique_ptr<algebra::SpdSolver> of_K_;
};

}  // namespace

MakeSpdSolver factor(algebra::Ordering ordering) {
  return {[ordering](const SpdSystem& s) { return algebra::factored(s.lower, problem::nodes(s.problem), ordering); }};
}

MakeSpdSolver incomplete_factor() {
  return {[](const SpdSystem& s) { return algebra::incompletely_factored(s.lower, s.monitor); }};
}

MakeSpdSolver multigrid(Levels levels, double most_iterations) {
  const auto make = [levels, most_iterations](const SpdSystem& s) -> std::unique_ptr<algebra::SpdSolver> {
    const std::vector<int> nodes = problem::nodes(s.problem);
    const auto coarse = levels == Levels::meshes ? problem::coarse_functions(s.problem) : std::vector<algebra::CoarseFunctions>();
    const bool of_signs = s.basis.of_signs(), other_signs = of_signs && !s.basis.trivial();
    StoredMatrix K;
    if (!s.slices && !of_signs) K = problem::lower_stiffness(s.problem);
    else if (!s.slices && other_signs) K = s.lower, K = s.basis.with_signs(std::move(K));
    algebra::Triplets changed, beside;
    if (other_signs) changed = SignedSolver::of_K(s.changed, s.basis.signs), beside = SignedSolver::of_K(s.beside_slices, s.basis.signs);
    multigrid::Matrix matrix{other_signs && !s.slices ? K : s.lower, nodes, [&] { return all_rigid_motions(s.problem, coarse); }};
    matrix.rows = &s.problem.B, matrix.changed = other_signs ? &changed : &s.changed;
    matrix.slices = s.slices, matrix.beside_slices = other_signs ? &beside : &s.beside_slices;
    matrix.most_iterations = most_iterations;
    if (!coarse.empty()) matrix.coarse = &coarse, matrix.coarser = s.coarser;
    const SparseMatrix unknowns = of_signs ? SparseMatrix() : s.basis.of_displacements(s.problem);
    if (!of_signs) matrix.unknowns = &unknowns, matrix.displaced = s.slices ? nullptr : &K;
    try {
      auto solver = multigrid::make_solver(matrix, s.monitor);
      if (!other_signs) return solver;
      return std::make_unique<SignedSolver>(s.basis.signs, s.near_rows, std::move(solver));
    } catch (const multigrid::Unavailable& error) {
      throw NotSolved(error.what());
    }
  };
  return {make, levels == Levels::meshes};  // aggregates of a mesh that has coarser ones: nested iteration wants the whole
}

}  // namespace dotyk::solver

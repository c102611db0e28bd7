#include "algebra/spd_solver.hpp"

#include <optional>

#include "algebra/direct/cholesky.hpp"
#include "algebra/krylov/conjugate_gradient.hpp"
#include "base/error.hpp"

namespace dotyk::algebra {
namespace {

void put(const Triplets& changed, SparseMatrix& lower) {
  for (const auto& entry : changed) lower.coeffRef(entry.row(), entry.col()) = entry.value();
}

class Factored final : public SpdSolver {
 public:
  Factored(const SparseMatrix& lower, const std::vector<int>& node, Ordering ordering) : lower_(lower), factor_(lower, node, {}, ordering) {}
  bool set(const Triplets& changed, const std::vector<char>&) override {
    put(changed, lower_);
    return factor_.factor(lower_);
  }
  Vector solve(const Vector& b, double, Vector*) override { return factor_.solve(b); }
  bool iterates() const override { return false; }
  double bytes() const override { return factor_.bytes(); }
  std::string method() const override { return factor_.method(); }

 private:
  SparseMatrix lower_;
  Cholesky factor_;
};

class IncompletelyFactored final : public SpdSolver {
 public:
  IncompletelyFactored(const SparseMatrix& lower, Monitor& monitor) : monitor_(monitor), lower_(lower) {}

  bool set(const Triplets& changed, const std::vector<char>&) override {
    put(changed, lower_);
    try {
      preconditioner_.emplace(lower_);
    } catch (const InputError&) {
      return false;
    }
    return true;
  }

  Vector solve(const Vector& b, double tolerance, Vector* left) override {
    const Vector x = conjugate_gradient(*preconditioner_, b, {tolerance}, monitor_).x;
    if (left) *left = b - lower_.selfadjointView<Eigen::Lower>() * x;
    return x;
  }
  double bytes() const override { return preconditioner_ ? preconditioner_->bytes() : 0; }
  std::string method() const override { return "conjugate gradients, incomplete Cholesky factor"; }

 private:
  Monitor& monitor_;
  SparseMatrix lower_;
  std::optional<IncompleteCholesky> preconditioner_;
};

}  // namespace

std::unique_ptr<SpdSolver> factored(const SparseMatrix& lower, const std::vector<int>& node, Ordering ordering) {
  return std::make_unique<Factored>(lower, node, ordering);
}

std::unique_ptr<SpdSolver> incompletely_factored(const SparseMatrix& lower, Monitor& monitor) {
  return std::make_unique<IncompletelyFactored>(lower, monitor);
}

}  // namespace dotyk::algebra

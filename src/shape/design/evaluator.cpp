#include "shape/design/evaluator.hpp"

#include "base/error.hpp"
#include "base/stopwatch.hpp"

namespace dotyk::shape {

std::shared_ptr<const DesignState> Evaluator::solved(const Vector& alpha, const std::shared_ptr<Cost>& cost) try {
  InnerMonitor inner(monitor_);
  auto state = std::make_shared<const DesignState>(space_, alpha, method_, last_.get(), cost, inner);
  monitor_.check();
  if (state->solution()->result().converged) return state;
  refusal_ = "the solve did not converge: " + state->solution()->result().reason;
  return nullptr;
} catch (const InputError& error) {
  refusal_ = error.what();
  return nullptr;
}

Vector Evaluator::values(const DesignState& state) const {
  Vector v(static_cast<Eigen::Index>(sought_.size()));
  for (Eigen::Index j = 0; j < v.size(); ++j) v[j] = sought_[static_cast<std::size_t>(j)].quantity->value(state) - sought_[static_cast<std::size_t>(j)].most;
  return v;
}

DenseMatrix Evaluator::exact(const DesignState& state) const {
  DenseMatrix g(static_cast<Eigen::Index>(sought_.size()), space_->variables());
  for (Eigen::Index j = 0; j < g.rows(); ++j) g.row(j) = sought_[static_cast<std::size_t>(j)].quantity->gradient(state);
  return g;
}

DenseMatrix Evaluator::differences(const DesignState& state, const Vector& at) {
  DenseMatrix g(at.size(), space_->variables());
  for (int i = 0; i < space_->variables(); ++i) {
    Vector alpha = state.alpha();
    alpha[i] += step_;
    const auto beside = solved(alpha, beside_);
    if (!beside) throw InputError(text("the design at ", step_, " beside in variable ", i + 1, ", for a difference, is not admissible: ", refusal_));
    g.col(i) = (values(*beside) - at) / step_;
  }
  return g;
}

std::optional<Evaluation> Evaluator::operator()(const Vector& alpha) {
  refusal_.clear();
  Stopwatch watch;
  const auto state = solved(alpha, designs_);
  analysis_seconds_ += watch.lap();
  if (!state) return std::nullopt;
  try {
    const Vector at = values(*state);
    const DenseMatrix g = step_ > 0 ? differences(*state, at) : exact(*state);
    derivative_seconds_ += watch.lap();
    last_ = state;
    return Evaluation{at[0], g.row(0), at.tail(at.size() - 1), g.bottomRows(g.rows() - 1)};
  } catch (const InputError& error) {  // at friction's kinks, say: a step that ends elsewhere may do
    refusal_ = error.what();
    return std::nullopt;
  }
}

}  // namespace dotyk::shape

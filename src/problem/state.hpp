#pragma once

#include <memory>
#include <utility>

#include "algebra/field.hpp"

namespace dotyk::problem {

/// A displacement of all unknowns. Where it lies with the stiffness, all its numbers come here when they are first asked for. Copies share what lies there. Not
/// for several threads at once, as fields are not.
class Displacement {
 public:
  Displacement() = default;
  Displacement(algebra::Vector numbers) : here_(std::move(numbers)), known_(true) {}  // NOLINT: taken wherever numbers are given
  template <class Derived>
  Displacement(const Eigen::MatrixBase<Derived>& numbers) : here_(numbers), known_(true) {}  // NOLINT
  explicit Displacement(algebra::Field field) : there_(std::make_shared<const algebra::Field>(std::move(field))) {}

  Eigen::Index size() const { return there_ ? there_->where()->unknowns() : here_.size(); }
  const algebra::Vector& here() const {
    if (there_ && !known_) here_ = there_->get(), known_ = true;
    return here_;
  }
  operator const algebra::Vector&() const { return here(); }  // NOLINT
  /// For writing. From then on the numbers lie here alone.
  algebra::Vector& change() {
    here();
    there_ = nullptr;
    return here_;
  }
  const std::shared_ptr<const algebra::Field>& there() const { return there_; }  ///< null: it lies here alone

 private:
  std::shared_ptr<const algebra::Field> there_;
  mutable algebra::Vector here_;
  mutable bool known_ = false;
};

struct State {
  Displacement u;          ///< unknowns
  algebra::Vector lambda;  ///< rows
};

}  // namespace dotyk::problem

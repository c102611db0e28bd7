#include "problem/law.hpp"

namespace dotyk::problem {
namespace {

/// x ≤ 0, λ ≥ 0, λx = 0 with x = Bu − c, minus the gap: see law.hpp.
class Unilateral final : public Law {
 public:
  std::string name() const override { return "unilateral"; }
  Projection project(int, double y, double) const override {
    return y > 0 ? Projection{y, 1} : Projection{0, 0};
  }
  double energy(int, double) const override { return 0; }
  double conjugate(int, double) const override { return 0; }
  Interval multipliers(int) const override { return {0, kUnbounded}; }
  std::optional<Springs> springs(int) const override { return Springs{kUnbounded, kUnbounded}; }
  bool unilateral() const override { return true; }
};

class Bilateral final : public Law {
 public:
  std::string name() const override { return "bilateral"; }
  Projection project(int, double y, double) const override { return {y, 1}; }
  double energy(int, double) const override { return 0; }
  double conjugate(int, double) const override { return 0; }
  Interval multipliers(int) const override { return {-kUnbounded, kUnbounded}; }
  std::optional<Springs> springs(int) const override { return Springs{kUnbounded, kUnbounded}; }
  std::optional<double> linear_stiffness(int) const override { return kUnbounded; }
};

}  // namespace

std::shared_ptr<const Law> unilateral() { return std::make_shared<Unilateral>(); }

std::shared_ptr<const Law> bilateral() { return std::make_shared<Bilateral>(); }

}  // namespace dotyk::problem

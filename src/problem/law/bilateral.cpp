#include "problem/law.hpp"

namespace dotyk::problem {
namespace {

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

std::shared_ptr<const Law> bilateral() { return std::make_shared<Bilateral>(); }

}  // namespace dotyk::problem

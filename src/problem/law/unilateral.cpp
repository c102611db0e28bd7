#include "problem/law_choice.hpp"

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

const LawSpec laws::free{.name = "free", .words = "free", .help = "A support that does nothing.", .traits = {}};

const LawSpec laws::prescribed{
    .name = "prescribed", .words = "prescribed", .help = "Prescribes the displacement.",
    .traits = {.prescribes = true, .rigid = true, .pushes = true, .pulls = true},
    .numbers = {{{.name = "v", .role = LawNumber::Role::displacement, .help = "the deflection, rotation or displacement", .unit = "length, or rad", .example = "-1", .least = -Law::kUnbounded, .usual = 0}}},
    .rows = [](std::span<const LawRow>, double) { return bilateral(); }};

const LawSpec laws::load{
    .name = "load", .words = "load", .help = "A load: a force, a moment on the rotation, or a pressure on a part.",
    .traits = {.load = true, .pushes = true, .pulls = true},
    .numbers = {{{.name = "f", .role = LawNumber::Role::force, .help = "up, a moment anticlockwise; of a part into the body, a pressure", .unit = "force, or moment; on a part per length or area", .example = "-1", .least = -Law::kUnbounded}}}};

const LawSpec laws::signorini{
    .name = "signorini", .words = "Signorini", .help = "A rigid stop: the deflection stays at or above zero, a slope at or below zero, a part does not enter the support.",
    .traits = {.rigid = true, .pushes = true},
    .rows = [](std::span<const LawRow>, double) { return unilateral(); }};

}  // namespace dotyk::problem

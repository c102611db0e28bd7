#include "problem/range.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/moderate.hpp"
#include "base/text.hpp"

namespace dotyk::problem {
namespace {

constexpr double kMostStiffness = 1e120, kMostDisplacement = 1e175;

void require(double size, double most, const char* what) {
  if (!moderate(size, most))
    throw InputError(text("values beyond the range of numbers: ", what, " are about ", size, ", and what is beyond ", most, " or below ", 1 / most,
                          " is lost where it is squared; choose units in which stiffness, loads and sizes are moderate"));
}

}  // namespace

void require_moderate(const Problem& problem, double most_force) {
  double stiffness = 0, force = 0, gap = 0;
  const auto grow = [](double& greatest, double value) { greatest = std::isnan(value) ? INFINITY : std::max(greatest, std::abs(value)); };
  for (const Block& block : problem.blocks) {
    const algebra::Vector diagonal = block.K.diagonal();
    for (const double k : diagonal) grow(stiffness, k);
    for (const double f : block.f) grow(force, f);
  }
  for (const double c : problem.c)
    if (!std::isinf(c)) grow(gap, c);
  require(stiffness, kMostStiffness, "stiffnesses");
  require(force, most_force, "loads");
  require(gap, kMostDisplacement, "gaps and prescribed displacements");
  grow(force, gap * stiffness);
  require(force, most_force, "forces");
  require(stiffness > 0 ? force / stiffness : 0, kMostDisplacement, "displacements");
}

}  // namespace dotyk::problem

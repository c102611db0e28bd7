#include "problem/range.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::problem {
namespace {

/// Squares stay within 1e±240, and leave room for sums and for what is small beside the greatest.
constexpr double kMost = 1e120;

void require(double size, const char* what) {
  if (size == 0 || (size <= kMost && size >= 1 / kMost)) return;
  throw InputError(text("values beyond the range of numbers: ", what, " are about ", size, ", and squares of what is beyond ", kMost, " or below ", 1 / kMost,
                        " are lost; choose units in which stiffness, loads and sizes are moderate"));
}

}  // namespace

void require_moderate(const Problem& problem) {
  double stiffness = 0, force = 0, gap = 0;
  // Not std::max: nan counts.
  const auto grow = [](double& most, double value) {
    if (!(std::abs(value) <= most)) most = std::abs(value);
  };
  for (const Block& block : problem.blocks) {
    const algebra::Vector diagonal = block.K.diagonal();
    for (const double k : diagonal) grow(stiffness, k);
    for (const double f : block.f) grow(force, f);
  }
  for (const double c : problem.c)
    if (!std::isinf(c)) grow(gap, c);
  require(stiffness, "stiffnesses");
  require(force, "loads");
  require(gap, "gaps and prescribed displacements");
  grow(force, gap * stiffness);
  require(force, "forces");
  require(stiffness > 0 ? force / stiffness : 0, "displacements");
}

}  // namespace dotyk::problem

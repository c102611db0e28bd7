#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "algebra/field.hpp"

namespace dotyk::algebra {

/// What is left of the equations A u = b, and how much of it in ‖·‖₁ may be.
struct Remainder {
  Field left;
  double enough;
};

/// A change of u, and what of the remainder it takes away.
struct ResidualDirection {
  Field u, change;
};

/// Generalised conjugate residuals for a matrix that need not be symmetric (Eisenstat, Elman and Schultz, SIAM J. Numer. Anal. 20 (1983)), begun anew after
/// some directions. direct(left) gives the next one, from a preconditioner; arrive(change) adds a change, if there is one, to u and forms the remainder
/// anew. Ends where that is small enough, after kMost directions, or where a direction is in the span of those before but for rounding.
template <class Arrive, class Direct>
void conjugate_residuals(const Arrive& arrive, const Direct& direct) {
  constexpr int kMost = 60;
  constexpr std::size_t kKept = 20;
  constexpr double kCancelled = 1e-24;  // of ‖change‖²
  std::vector<std::pair<ResidualDirection, double>> directions;  // with ‖change‖²
  std::optional<Field> total;
  Remainder rest = arrive(total);
  const auto arrived = [&] {
    if (total) rest = arrive(total), total.reset(), directions.clear();
    return rest.left.moduli() <= rest.enough;
  };
  for (int k = 0; k < kMost; ++k) {
    const double left = rest.left.moduli();
    if (!std::isfinite(left)) break;
    if ((left <= rest.enough || directions.size() == kKept) && arrived()) return;
    ResidualDirection d = direct(rest.left);  // changes rest.left meanwhile, and restores it
    const double whole = d.change.dot(d.change);
    for (const auto& [old, size] : directions) {
      const double share = d.change.dot(old.change) / size;
      d.u.add(-share, old.u), d.change.add(-share, old.change);
    }
    const double size = d.change.dot(d.change);
    if (!(size > kCancelled * whole)) break;
    const double step = rest.left.dot(d.change) / size;
    if (!total) total.emplace(d.u.where());
    total->add(step, d.u);
    rest.left.add(-step, d.change);
    directions.emplace_back(std::move(d), size);
  }
  if (total) arrive(total);
}

}  // namespace dotyk::algebra

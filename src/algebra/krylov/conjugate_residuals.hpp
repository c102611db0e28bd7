#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// What is left of the equations A u = b, and how much of it in ‖·‖₁ may be.
struct Remainder {
  Vector left;
  double enough;
};

/// A change of u, and what of the remainder it takes away.
struct ResidualDirection {
  Vector u, change;
};

/// Generalised conjugate residuals for a matrix that need not be symmetric (Eisenstat, Elman and Schultz, SIAM J. Numer. Anal. 20 (1983)), begun anew after
/// some directions. direct(left) gives the next one, from a preconditioner; arrive(change) adds a change, if there is one, to u and forms the remainder
/// anew. Ends where that is small enough, after kMost directions, or where a direction is in the span of those before but for rounding.
template <class Arrive, class Direct>
void conjugate_residuals(const Arrive& arrive, const Direct& direct) {
  constexpr int kMost = 60;
  constexpr std::size_t kKept = 20;
  constexpr double kCancelled = 1e-24;  // of ‖change‖²
  std::vector<ResidualDirection> directions;
  std::optional<Vector> total;
  Remainder rest = arrive(total);
  const auto arrived = [&] {
    if (total) rest = arrive(total), total.reset(), directions.clear();
    return rest.left.template lpNorm<1>() <= rest.enough;
  };
  for (int k = 0; k < kMost && rest.left.allFinite(); ++k) {
    if ((rest.left.template lpNorm<1>() <= rest.enough || directions.size() == kKept) && arrived()) return;
    ResidualDirection d = direct(rest.left);
    const double whole = d.change.squaredNorm();
    for (const ResidualDirection& old : directions) {
      const double share = d.change.dot(old.change) / old.change.squaredNorm();
      d.u -= share * old.u, d.change -= share * old.change;
    }
    const double size = d.change.squaredNorm();
    if (!(size > kCancelled * whole)) break;
    const double step = rest.left.dot(d.change) / size;
    total = total ? Vector(*total + step * d.u) : Vector(step * d.u);
    rest.left -= step * d.change;
    directions.push_back(std::move(d));
  }
  if (total) arrive(total);
}

}  // namespace dotyk::algebra

#include "problem/law.hpp"

#include <cmath>

namespace dotyk::problem {

const char* status_name(Status status) {
  switch (status) {
    case Status::open: return "open";
    case Status::closed: return "closed";
    case Status::stick: return "stick";
    default: return "slip";
  }
}

bool kinked_at_zero(const Law& law, int row) {
  const auto k = law.springs(row);
  return k && k->below != k->above;
}

Interval following(const Law& law, int row) {
  const Springs k = law.springs(row).value();
  const auto [low, high] = law.multipliers(row);
  const auto stretched = [](double lambda, double stiffness) {
    return lambda == 0 || !std::isfinite(lambda) ? lambda : lambda / stiffness;
  };
  return {stretched(low, k.below), stretched(high, k.above)};
}

}  // namespace dotyk::problem

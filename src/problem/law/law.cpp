#include "problem/law.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace dotyk::problem {

const char* status_name(Status status) {
  switch (status) {
    case Status::open: return "open";
    case Status::closed: return "closed";
    case Status::stick: return "stick";
    default: return "slip";
  }
}

Response Law::respond(int row, double x) const {
  const Springs k = springs(row).value();
  const auto [low, high] = multipliers(row);
  const double own = x < 0 ? k.below : k.above, end = x < 0 ? low : high;
  if (!std::isfinite(own)) return x != 0 && std::isfinite(end) ? Response{end, 0} : Response{0, kUnbounded};
  const double lambda = std::clamp(own * x, low, high);
  return {lambda, lambda == own * x ? own : 0};
}

double Law::displacement(int row, double lambda) const {
  const Springs k = springs(row).value();
  return lambda / (lambda > 0 ? k.above : k.below);
}

std::vector<double> Law::kinks(int row) const {
  const auto [low, high] = multipliers(row);
  if (low == high) return {};
  std::set<double> at;
  if (kinked_at_zero(*this, row)) at.insert(0);
  const Interval x = following(*this, row);
  for (const double end : {x.low, x.high})
    if (std::isfinite(end)) at.insert(end);
  return {at.begin(), at.end()};
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

#pragma once

#include <string>
#include <vector>

#include "problem/law.hpp"

namespace dotyk::problem {

/// The force of a spring, cut off at two limits.
struct Limits {
  double stiffness = 0;  ///< k ≥ 0, force per displacement; infinite: rigid until a limit is reached
  double low = 0;        ///< ≤ 0, force; may be −∞
  double high = 0;       ///< ≥ 0, force; may be ∞
};

/// λ = kx where that lies between low and high, else the nearer of them (rigid: any λ between them at x = 0):
///   φ(x) = max over low ≤ λ ≤ high of λx − λ²/2k,   φ*(λ) = λ²/2k,   P(y) = y k/(k + ρ) cut off at low and high.
/// Of supports of beams (P4, figures 10 to 14) those with a branch of their own: one-sided elastic (0 and ∞), rigid
/// friction (k infinite, −g and g), one-sided rigid friction (k infinite, 0 and g), capped elastic (−g and g).
/// `name`: for messages. Throws InputError where a stiffness is negative or nan, low > 0 or high < 0.
std::shared_ptr<const Law> limited(std::string name, std::vector<Limits> limits);

}  // namespace dotyk::problem

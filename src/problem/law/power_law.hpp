#pragma once

#include <memory>
#include <vector>

#include "problem/law.hpp"

namespace dotyk::problem {

/// Normal compliance, φ = c x⁺^(m+1)/(m+1), λ = c x⁺^m (Martins and Oden 1987; Kikuchi and Oden 1988, chapter 11): asperities that are pressed
/// flat. P(y) = y − ρx with x ≥ 0 from c x^m + ρx = y; φ*(λ) = m/(m+1) λ (λ/c)^(1/m). λ(x) is no line: Law::springs is absent.
/// `factors[row]`: c in force per displacement to the power m; throws InputError unless each is finite and ≥ 0, and m ≥ 1.
std::shared_ptr<const Law> power_law(std::vector<double> factors, double power);

}  // namespace dotyk::problem

#pragma once

namespace dotyk::test {

/// Young's modulus, Poisson's ratio and Lamé's moduli where exact solutions are compared with.
inline constexpr double kE = 3, kNu = 0.3, kMu = kE / (2 * (1 + kNu)), kLambda = kE * kNu / ((1 + kNu) * (1 - 2 * kNu));

}  // namespace dotyk::test

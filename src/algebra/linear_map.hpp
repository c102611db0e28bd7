#pragma once

#include <functional>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A linear map, known by what it makes of a vector.
using LinearMap = std::function<Vector(const Vector&)>;

/// ‖3A(v/3) − Av‖, a sample of the rounding in `Av`: v/3 has other digits than v.
inline double rounding_seen(const LinearMap& A, const Vector& v, const Vector& Av) { return (3 * A(v / 3) - Av).norm(); }

}  // namespace dotyk::algebra

#pragma once

#include <functional>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A linear map, known by what it makes of a vector.
using LinearMap = std::function<Vector(const Vector&)>;

}  // namespace dotyk::algebra

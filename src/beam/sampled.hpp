#pragma once

#include <functional>
#include <vector>

namespace dotyk::beam {

/// A function on the cells between ascending nodes as the polynomial of degree 7 in each that has its values at eight
/// Chebyshev points: f is called here and never again.
std::function<double(double)> sampled(const std::function<double(double)>& f, std::vector<double> nodes);

}  // namespace dotyk::beam

#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "algebra/dense/quadrature.hpp"

namespace dotyk::beam {

using Four = Eigen::Vector4d;

/// The cubic Hermite functions on a cell of length h at 0 ≤ s ≤ 1, for the end values (u₀, θ₀, u₁, θ₁), and their
/// first and second derivatives by x.
struct Hermite {
  Hermite(double s, double h);
  Four value, slope, curvature;
};

/// Gauss's rule with eight points on 0 ≤ s ≤ 1.
const algebra::Quadrature& rule();

/// ∫ EJ N″N″ᵀ over the cell from x0 to x0 + h, and ∫ q N, for constants in closed form, for functions by Gauss's rule
/// with eight points: with EJ constant the loads are exact for polynomials q up to degree 12.
Eigen::Matrix4d stiffness(double EJ, double h);
Eigen::Matrix4d stiffness(const std::function<double(double)>& EJ, double x0, double h);
Four load(double q, double h);
Four load(const std::function<double(double)>& q, double x0, double h);

/// ∫ f over the interval by the same rule.
double integral(const std::function<double(double)>& f, double from, double to);

/// A function on the cells between ascending nodes as the polynomial of degree 7 in each that has its values at eight
/// Chebyshev points: f is called here and never again.
std::function<double(double)> sampled(const std::function<double(double)>& f, std::vector<double> nodes);

}  // namespace dotyk::beam

#pragma once

// Shape functions, gradients and quadrature of the reference cells and facets,
// as compile-time types so that element kernels unroll. Elements of order 2: second_order_element.hpp. Used inside this room only.

#include <array>
#include <cmath>

#include "mesh/element.hpp"

namespace dotyk::elasticity {

inline constexpr double kGauss = 0.57735026918962576451;  // 1/√3
inline constexpr double kGauss3 = 0.77459666924148337704;  // √(3/5), of three points

/// Linear triangle on (0,0) (1,0) (0,1). Gradients are constant: one point for
/// stiffness; three (exact for quadratics) for loads.
struct TriangleP1 {
  static constexpr int dim = 2, nodes = 3, points = 1, load_points = 3;
  static constexpr bool simplex = true;
  static std::array<double, 2> centre() { return {1.0 / 3, 1.0 / 3}; }
  static constexpr double weight(int) { return 0.5; }
  static constexpr double load_weight(int) { return 1.0 / 6; }
  static std::array<double, 2> point(int) { return {1.0 / 3, 1.0 / 3}; }
  static std::array<double, 2> load_point(int q) {
    return {q == 1 ? 2.0 / 3 : 1.0 / 6, q == 2 ? 2.0 / 3 : 1.0 / 6};
  }
  static std::array<double, 3> shape(const std::array<double, 2>& x) {
    return {1 - x[0] - x[1], x[0], x[1]};
  }
  static void gradient(const std::array<double, 2>&, double g[3][2]) {
    static constexpr double d[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 2; ++i) g[a][i] = d[a][i];
  }
};

/// Linear tetrahedron on the unit simplex.
struct TetrahedronP1 {
  static constexpr int dim = 3, nodes = 4, points = 1, load_points = 4;
  static constexpr bool simplex = true;
  static std::array<double, 3> centre() { return {0.25, 0.25, 0.25}; }
  static constexpr double weight(int) { return 1.0 / 6; }
  static constexpr double load_weight(int) { return 1.0 / 24; }
  static std::array<double, 3> point(int) { return {0.25, 0.25, 0.25}; }
  static std::array<double, 3> load_point(int q) {  // exact for quadratics
    constexpr double a = 0.13819660112501051518, b = 0.58541019662496845446;
    return {q == 1 ? b : a, q == 2 ? b : a, q == 3 ? b : a};
  }
  static std::array<double, 4> shape(const std::array<double, 3>& x) {
    return {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
  }
  static void gradient(const std::array<double, 3>&, double g[4][3]) {
    for (int a = 0; a < 4; ++a)
      for (int i = 0; i < 3; ++i) g[a][i] = a == 0 ? -1 : (a == i + 1 ? 1 : 0);
  }
};

/// Bilinear quadrilateral on [-1,1]², 2×2 Gauss points.
struct QuadrilateralQ1 {
  static constexpr int dim = 2, nodes = 4, points = 4, load_points = 4;
  static constexpr bool simplex = false;
  static std::array<double, 2> centre() { return {0, 0}; }
  static constexpr double s[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  static constexpr double weight(int) { return 1; }
  static constexpr double load_weight(int) { return 1; }
  static std::array<double, 2> point(int q) { return {kGauss * s[q][0], kGauss * s[q][1]}; }
  static std::array<double, 2> load_point(int q) { return point(q); }
  static std::array<double, 4> shape(const std::array<double, 2>& x) {
    std::array<double, 4> n;
    for (int a = 0; a < 4; ++a) n[a] = 0.25 * (1 + s[a][0] * x[0]) * (1 + s[a][1] * x[1]);
    return n;
  }
  static void gradient(const std::array<double, 2>& x, double g[4][2]) {
    for (int a = 0; a < 4; ++a) {
      g[a][0] = 0.25 * s[a][0] * (1 + s[a][1] * x[1]);
      g[a][1] = 0.25 * s[a][1] * (1 + s[a][0] * x[0]);
    }
  }
};

/// Trilinear hexahedron on [-1,1]³, 2×2×2 Gauss points.
struct HexahedronQ1 {
  static constexpr int dim = 3, nodes = 8, points = 8, load_points = 8;
  static constexpr bool simplex = false;
  static std::array<double, 3> centre() { return {0, 0, 0}; }
  static constexpr double s[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  static constexpr double weight(int) { return 1; }
  static constexpr double load_weight(int) { return 1; }
  static std::array<double, 3> point(int q) {
    return {kGauss * s[q][0], kGauss * s[q][1], kGauss * s[q][2]};
  }
  static std::array<double, 3> load_point(int q) { return point(q); }
  static std::array<double, 8> shape(const std::array<double, 3>& x) {
    std::array<double, 8> n;
    for (int a = 0; a < 8; ++a)
      n[a] = 0.125 * (1 + s[a][0] * x[0]) * (1 + s[a][1] * x[1]) * (1 + s[a][2] * x[2]);
    return n;
  }
  static void gradient(const std::array<double, 3>& x, double g[8][3]) {
    for (int a = 0; a < 8; ++a) {
      const double u = 1 + s[a][0] * x[0], v = 1 + s[a][1] * x[1], w = 1 + s[a][2] * x[2];
      g[a][0] = 0.125 * s[a][0] * v * w;
      g[a][1] = 0.125 * s[a][1] * u * w;
      g[a][2] = 0.125 * s[a][2] * u * v;
    }
  }
};

}  // namespace dotyk::elasticity

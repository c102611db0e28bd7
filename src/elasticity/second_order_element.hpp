#pragma once

// Reference cells of order 2, nodes as mesh::ElementTopology numbers them. Stiffness is integrated exactly on straight
// simplices and on parallelograms (3 or 4 points, 3 Gauss points an axis), loads to degree 4 or more. Used inside this room only.

#include <array>

#include "elasticity/reference_element.hpp"
#include "mesh/element.hpp"

namespace dotyk::elasticity {

/// Quadratic simplex in barycentric coordinates λ: λ_i(2λ_i − 1) at corners, 4λ_iλ_j between them.
template <int Dim, int Nodes>
struct SimplexP2 {
  static constexpr int dim = Dim, nodes = Nodes, corners = Dim + 1;
  static constexpr bool simplex = true;
  static constexpr int kEdge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};  // of a triangle the first three
  using Point = std::array<double, Dim>;

  static Point centre() {
    Point x;
    x.fill(1.0 / corners);
    return x;
  }
  static std::array<double, corners> barycentric(const Point& x) {
    std::array<double, corners> l;
    l[0] = 1;
    for (int i = 0; i < Dim; ++i) l[i + 1] = x[i], l[0] -= x[i];
    return l;
  }
  static Point node(int a) {
    Point x{};
    for (int i = 0; i < Dim; ++i) {
      if (a < corners)
        x[i] = a == i + 1;
      else
        x[i] = 0.5 * ((kEdge[a - corners][0] == i + 1) + (kEdge[a - corners][1] == i + 1));
    }
    return x;
  }
  static std::array<double, Nodes> shape(const Point& x) {
    const auto l = barycentric(x);
    std::array<double, Nodes> n;
    for (int a = 0; a < corners; ++a) n[a] = l[a] * (2 * l[a] - 1);
    for (int e = 0; e < Nodes - corners; ++e) n[corners + e] = 4 * l[kEdge[e][0]] * l[kEdge[e][1]];
    return n;
  }
  static void gradient(const Point& x, double g[Nodes][Dim]) {
    const auto l = barycentric(x);
    const auto slope = [](int corner, int i) { return corner == 0 ? -1.0 : corner == i + 1 ? 1.0 : 0.0; };  // ∂λ/∂x_i
    for (int i = 0; i < Dim; ++i) {
      for (int a = 0; a < corners; ++a) g[a][i] = (4 * l[a] - 1) * slope(a, i);
      for (int e = 0; e < Nodes - corners; ++e) {
        const int a = kEdge[e][0], b = kEdge[e][1];
        g[corners + e][i] = 4 * (l[a] * slope(b, i) + l[b] * slope(a, i));
      }
    }
  }
};

struct TriangleP2 : SimplexP2<2, 6> {
  static constexpr int points = 3, load_points = 6;
  static constexpr double weight(int) { return 1.0 / 6; }
  static Point point(int q) { return {q == 1 ? 2.0 / 3 : 1.0 / 6, q == 2 ? 2.0 / 3 : 1.0 / 6}; }
  // Degree 4 (Dunavant 1985).
  static constexpr double load_weight(int q) { return q < 3 ? 0.5 * 0.22338158967801146570 : 0.5 * 0.10995174365532186764; }
  static Point load_point(int q) {
    const double a = q < 3 ? 0.44594849091596488632 : 0.09157621350977074346;
    return {q % 3 == 1 ? 1 - 2 * a : a, q % 3 == 2 ? 1 - 2 * a : a};
  }
};

struct TetrahedronP2 : SimplexP2<3, 10> {
  static constexpr int points = 4, load_points = 14;
  static constexpr double weight(int) { return 1.0 / 24; }
  static Point point(int q) { return corner_point(q, 0.13819660112501051518); }
  // Degree 5 (Walkington 2000).
  static constexpr double load_weight(int q) {
    return (q < 4 ? 0.11268792571801585080 : q < 8 ? 0.07349304311636194954 : 0.04254602077708146644) / 6;
  }
  static Point load_point(int q) {
    if (q < 4) return corner_point(q, 0.31088591926330060980);
    if (q < 8) return corner_point(q - 4, 0.09273525031089122640);
    constexpr double a = 0.04550370412564964949;
    std::array<double, 4> l{0.5 - a, 0.5 - a, 0.5 - a, 0.5 - a};
    l[kEdge[q - 8][0]] = l[kEdge[q - 8][1]] = a;
    return {l[1], l[2], l[3]};
  }

 private:
  /// λ = 1 − 3a at corner q, a at the others.
  static Point corner_point(int q, double a) {
    const double b = 1 - 3 * a;
    return {q == 1 ? b : a, q == 2 ? b : a, q == 3 ? b : a};
  }
};

/// Products of quadratic functions of each coordinate on [-1, 1], three Gauss points an axis.
template <int Dim, int Nodes>
struct TensorQ2 {
  static constexpr int dim = Dim, nodes = Nodes, points = Nodes, load_points = Nodes;
  static constexpr bool simplex = false;
  /// Where a node is, an axis each; in the plane the first 9 of its own list.
  static constexpr int kPlane[9][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
  static constexpr int kSpace[27][3] = {
      {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, -1, -1},
      {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}, {0, -1, 1}, {1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},
      {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}};
  using Point = std::array<double, Dim>;

  static constexpr const int* at(int a) { return Dim == 2 ? kPlane[a % 9] : kSpace[a]; }
  static Point centre() { return {}; }
  static Point node(int a) {
    Point x;
    for (int i = 0; i < Dim; ++i) x[i] = at(a)[i];
    return x;
  }
  static Point point(int q) {
    Point x;
    for (int i = 0; i < Dim; ++i, q /= 3) x[i] = (q % 3 - 1) * kGauss3;
    return x;
  }
  static constexpr double weight(int q) {
    double w = 1;
    for (int i = 0; i < Dim; ++i, q /= 3) w *= q % 3 == 1 ? 8.0 / 9 : 5.0 / 9;
    return w;
  }
  static Point load_point(int q) { return point(q); }
  static constexpr double load_weight(int q) { return weight(q); }

  static std::array<double, Nodes> shape(const Point& x) {
    const Lines lines(x);
    std::array<double, Nodes> n;
    for (int a = 0; a < Nodes; ++a) {
      n[a] = 1;
      for (int i = 0; i < Dim; ++i) n[a] *= lines.value[i][at(a)[i] + 1];
    }
    return n;
  }
  static void gradient(const Point& x, double g[Nodes][Dim]) {
    const Lines lines(x);
    for (int a = 0; a < Nodes; ++a)
      for (int i = 0; i < Dim; ++i) {
        g[a][i] = 1;
        for (int k = 0; k < Dim; ++k) g[a][i] *= k == i ? lines.slope[k][at(a)[k] + 1] : lines.value[k][at(a)[k] + 1];
      }
  }

 private:
  /// The three quadratic functions of each coordinate, and their derivatives.
  struct Lines {
    explicit Lines(const Point& x) {
      for (int i = 0; i < Dim; ++i) {
        value[i] = {0.5 * x[i] * (x[i] - 1), 1 - x[i] * x[i], 0.5 * x[i] * (x[i] + 1)};
        slope[i] = {x[i] - 0.5, -2 * x[i], x[i] + 0.5};
      }
    }
    std::array<std::array<double, 3>, Dim> value, slope;
  };
};

using QuadrilateralQ2 = TensorQ2<2, 9>;
using HexahedronQ2 = TensorQ2<3, 27>;

}  // namespace dotyk::elasticity

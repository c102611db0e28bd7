#pragma once

// Shape functions, gradients and quadrature of the reference cells and facets, nodes as mesh::ElementTopology numbers them: as
// compile-time types so that element kernels unroll. Stiffness is integrated exactly on straight simplices and on parallelograms (of
// curved ones see for_each_stiffness_point()), loads exactly where they are quadratic (order 1), or to degree 4 or more
// (order 2). Used inside this room only.

#include <array>

#include "mesh/element.hpp"

namespace dotyk::elasticity {

/// Simplex on (0, …) (1, 0, …) …, in barycentric coordinates λ. Order 1: λ_i. Order 2: λ_i(2λ_i − 1) at corners, 4λ_iλ_j between them.
template <int Dim, int Order>
struct Simplex {
  static constexpr int dim = Dim, order = Order, corners = Dim + 1, nodes = Order == 1 ? corners : corners + Dim * (Dim + 1) / 2;
  static constexpr bool simplex = true;
  static constexpr int kEdge[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};  // of a triangle the first three
  using Point = std::array<double, Dim>;

  static Point centre() {
    Point x;
    x.fill(1.0 / corners);
    return x;
  }
  /// λ = `own` at corner q, `others` at the others.
  static Point corner_point(int q, double own, double others) {
    Point x;
    for (int i = 0; i < Dim; ++i) x[i] = q == i + 1 ? own : others;
    return x;
  }
  static std::array<double, corners> barycentric(const Point& x) {
    std::array<double, corners> l;
    l[0] = 1;
    for (int i = 0; i < Dim; ++i) l[i + 1] = x[i], l[0] -= x[i];
    return l;
  }
  static Point node(int a) {
    if (a < corners) return corner_point(a, 1, 0);
    Point x{};
    for (int i = 0; i < Dim; ++i) x[i] = 0.5 * ((kEdge[a - corners][0] == i + 1) + (kEdge[a - corners][1] == i + 1));
    return x;
  }
  static std::array<double, nodes> shape(const Point& x) {
    const auto l = barycentric(x);
    std::array<double, nodes> n;
    for (int a = 0; a < corners; ++a) n[a] = Order == 1 ? l[a] : l[a] * (2 * l[a] - 1);
    for (int e = 0; e < nodes - corners; ++e) n[corners + e] = 4 * l[kEdge[e][0]] * l[kEdge[e][1]];
    return n;
  }
  static void gradient(const Point& x, double g[nodes][Dim]) {
    const auto l = barycentric(x);
    const auto slope = [](int corner, int i) { return corner == 0 ? -1.0 : corner == i + 1 ? 1.0 : 0.0; };  // ∂λ/∂x_i
    for (int i = 0; i < Dim; ++i) {
      for (int a = 0; a < corners; ++a) g[a][i] = Order == 1 ? slope(a, i) : (4 * l[a] - 1) * slope(a, i);
      for (int e = 0; e < nodes - corners; ++e) {
        const int a = kEdge[e][0], b = kEdge[e][1];
        g[corners + e][i] = 4 * (l[a] * slope(b, i) + l[b] * slope(a, i));
      }
    }
  }
};

struct TriangleP1 : Simplex<2, 1> {
  static constexpr int points = 1, load_points = 3;
  static constexpr double weight(int) { return 0.5; }
  static constexpr double load_weight(int) { return 1.0 / 6; }
  static Point point(int) { return centre(); }
  static Point load_point(int q) { return corner_point(q, 2.0 / 3, 1.0 / 6); }
};

struct TetrahedronP1 : Simplex<3, 1> {
  static constexpr int points = 1, load_points = 4;
  static constexpr double weight(int) { return 1.0 / 6; }
  static constexpr double load_weight(int) { return 1.0 / 24; }
  static Point point(int) { return centre(); }
  static Point load_point(int q) { return corner_point(q, 0.58541019662496845446, 0.13819660112501051518); }
};

struct TriangleP2 : Simplex<2, 2> {
  static constexpr int points = 3, load_points = 6;
  static constexpr double weight(int) { return 1.0 / 6; }
  static Point point(int q) { return corner_point(q, 2.0 / 3, 1.0 / 6); }
  // Degree 4 (Dunavant 1985).
  static constexpr double load_weight(int q) { return q < 3 ? 0.5 * 0.22338158967801146570 : 0.5 * 0.10995174365532186764; }
  static Point load_point(int q) {
    const double a = q < 3 ? 0.44594849091596488632 : 0.09157621350977074346;
    return corner_point(q % 3, 1 - 2 * a, a);
  }
};

struct TetrahedronP2 : Simplex<3, 2> {
  static constexpr int points = 4, load_points = 14;
  static constexpr double weight(int) { return 1.0 / 24; }
  static Point point(int q) { return about_corner(q, 0.13819660112501051518); }
  // Degree 5 (Walkington 2000).
  static constexpr double load_weight(int q) {
    return (q < 4 ? 0.11268792571801585080 : q < 8 ? 0.07349304311636194954 : 0.04254602077708146644) / 6;
  }
  static Point load_point(int q) {
    if (q < 4) return about_corner(q, 0.31088591926330060980);
    if (q < 8) return about_corner(q - 4, 0.09273525031089122640);
    constexpr double a = 0.04550370412564964949;
    std::array<double, 4> l{0.5 - a, 0.5 - a, 0.5 - a, 0.5 - a};
    l[kEdge[q - 8][0]] = l[kEdge[q - 8][1]] = a;
    return {l[1], l[2], l[3]};
  }

 private:
  static Point about_corner(int q, double others) { return corner_point(q, 1 - 3 * others, others); }
};

/// Where the nodes of lines, quadrilaterals and hexahedra of order 2 are, an axis each; those of order 1 have the first of them.
inline constexpr int kLine[3][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}};
inline constexpr int kPlane[9][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
inline constexpr int kSpace[27][3] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, -1, -1},
    {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}, {0, -1, 1}, {1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},
    {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}};

/// Products of linear (order 1) or quadratic functions of each coordinate on [-1, 1], two or three Gauss points an axis.
template <int Dim, int Order>
struct Tensor {
  static constexpr int dim = Dim, order = Order, side = Order + 1, nodes = Dim == 1 ? side : Dim == 2 ? side * side : side * side * side;
  static constexpr int points = nodes, load_points = nodes;
  static constexpr bool simplex = false;
  using Point = std::array<double, Dim>;

  static constexpr const int* at(int a) { return Dim == 1 ? kLine[a % 3] : Dim == 2 ? kPlane[a % 9] : kSpace[a]; }
  static Point centre() { return {}; }
  static Point node(int a) {
    Point x;
    for (int i = 0; i < Dim; ++i) x[i] = at(a)[i];
    return x;
  }
  /// Order 1: the point next to node q; order 2: along the first axis first.
  static Point point(int q) {
    constexpr double kTwo = 0.57735026918962576451, kThree = 0.77459666924148337704;  // 1/√3, √(3/5)
    Point x;
    for (int i = 0; i < Dim; ++i) x[i] = Order == 1 ? kTwo * at(q)[i] : (digit(q, i) - 1) * kThree;
    return x;
  }
  static constexpr double weight(int q) {
    double w = 1;
    for (int i = 0; i < Dim && Order == 2; ++i) w *= digit(q, i) == 1 ? 8.0 / 9 : 5.0 / 9;
    return w;
  }
  static Point load_point(int q) { return point(q); }
  static constexpr double load_weight(int q) { return weight(q); }

  static std::array<double, nodes> shape(const Point& x) {
    const Lines lines(x);
    std::array<double, nodes> n;
    for (int a = 0; a < nodes; ++a) {
      n[a] = 1;
      for (int i = 0; i < Dim; ++i) n[a] *= lines.value[i][at(a)[i] + 1];
    }
    return n;
  }
  static void gradient(const Point& x, double g[nodes][Dim]) {
    const Lines lines(x);
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < Dim; ++i) {
        g[a][i] = 1;
        for (int k = 0; k < Dim; ++k) g[a][i] *= k == i ? lines.slope[k][at(a)[k] + 1] : lines.value[k][at(a)[k] + 1];
      }
  }

 private:
  /// Of the number q to the base 3.
  static constexpr int digit(int q, int i) { return i == 0 ? q % 3 : i == 1 ? q / 3 % 3 : q / 9; }

  /// The functions of each coordinate that are 1 at −1, 0 (order 2 alone) and 1, and their derivatives.
  struct Lines {
    explicit Lines(const Point& x) {
      for (int i = 0; i < Dim; ++i) {
        if constexpr (Order == 1) {
          value[i] = {0.5 * (1 - x[i]), 0, 0.5 * (1 + x[i])};
          slope[i] = {-0.5, 0, 0.5};
        } else {
          value[i] = {0.5 * x[i] * (x[i] - 1), 1 - x[i] * x[i], 0.5 * x[i] * (x[i] + 1)};
          slope[i] = {x[i] - 0.5, -2 * x[i], x[i] + 0.5};
        }
      }
    }
    std::array<std::array<double, 3>, Dim> value, slope;
  };
};

using QuadrilateralQ1 = Tensor<2, 1>;
using HexahedronQ1 = Tensor<3, 1>;
using QuadrilateralQ2 = Tensor<2, 2>;
using HexahedronQ2 = Tensor<3, 2>;

}  // namespace dotyk::elasticity

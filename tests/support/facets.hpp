#pragma once

#include "meshes.hpp"

namespace dotyk::test {

/// The mesh without the cells whose centre `gone` accepts, and without the nodes that only they had.
/// Named parts are dropped.
inline Mesh without(const Mesh& whole, const std::function<bool(const Point&)>& gone) {
  Mesh m;
  m.element = whole.element;
  std::vector<int> number(whole.node_count(), -1);
  const int per_cell = whole.topology().nodes;
  for (int c = 0; c < whole.cell_count(); ++c) {
    if (gone(whole.cell_centre(c))) continue;
    for (int a = 0; a < per_cell; ++a) {
      int& n = number[whole.cell(c)[a]];
      if (n < 0) {
        n = m.node_count();
        m.coordinates.insert(m.coordinates.end(), whole.node(whole.cell(c)[a]),
                             whole.node(whole.cell(c)[a]) + m.dimension());
      }
      m.cells.push_back(n);
    }
  }
  return m;
}

/// The same mesh with its nodes in reverse order.
inline Mesh reversed(Mesh m) {
  const int n = m.node_count(), dim = m.dimension();
  std::vector<double> x;
  for (int i = n - 1; i >= 0; --i) x.insert(x.end(), m.node(i), m.node(i) + dim);
  m.coordinates = x;
  for (int& k : m.cells) k = n - 1 - k;
  return m;
}

}  // namespace dotyk::test

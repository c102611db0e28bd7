#pragma once

#include <cmath>

#include "contact/pairing.hpp"
#include "meshes.hpp"

namespace dotyk::test {

inline contact::Face face(const Mesh& m, const std::string& part) { return {m, m.parts.at(part), "'" + part + "'"}; }

/// Unit blocks above each other, of different cells, turned by an angle in the plane of the first and the last axis.
struct BlockPair {
  Mesh low, high;
};
inline BlockPair block_pair(int dim, Family one, Family other, int n, int m, double angle = 0) {
  BlockPair p{unit(dim, one, n), unit(dim, other, m)};
  mesh::transform(p.high, [&](Point x) { return x[dim - 1] += 1, x; });
  for (Mesh* mesh : {&p.low, &p.high})
    mesh::transform(*mesh, [&](const Point& x) {
      Point y = x;
      y[0] = std::cos(angle) * x[0] - std::sin(angle) * x[dim - 1];
      y[dim - 1] = std::sin(angle) * x[0] + std::cos(angle) * x[dim - 1];
      return y;
    });
  return p;
}

}  // namespace dotyk::test

#pragma once

#include <cmath>
#include <vector>

#include "mesh/point.hpp"

namespace dotyk::contact {

/// The axis that the first tangent in space lies along, made perpendicular: the one that n is least along.
inline int tangent_axis(const mesh::Point& n) {
  int least = 0;  // axes stay axes where they can
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[least]) - 1e-12) least = i;
  return least;
}

/// Unit tangents to the unit normal n: in the plane the one that n turned by 90° anticlockwise is; in space two,
/// perpendicular to each other, along axes where n is along one.
inline std::vector<mesh::Point> tangents(const mesh::Point& n, int dimension) {
  if (dimension == 2) return {{-n[1], n[0], 0}};
  const int least = tangent_axis(n);
  mesh::Point t = mesh::times(-n[least], n);
  t[least] += 1;
  const double size = mesh::length(t);
  for (double& v : t) v = std::abs(v) < 1e-15 ? 0 : v / size;
  return {t, mesh::cross(n, t)};
}

}  // namespace dotyk::contact

#include "contact/tangents.hpp"

#include <cmath>

namespace dotyk::contact {

using mesh::Point;
using mesh::cross;
using mesh::length;

int tangent_axis(const Point& n) {
  int least = 0;  // axes stay axes where they can
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[least]) - 1e-12) least = i;
  return least;
}

std::vector<Point> tangents(const Point& n, int dimension) {
  if (dimension == 2) return {{-n[1], n[0], 0}};
  const int least = tangent_axis(n);
  Point t{0, 0, 0};
  t[least] = 1;
  for (int i = 0; i < 3; ++i) t[i] -= n[least] * n[i];
  const double size = length(t);
  for (double& v : t) v = std::abs(v) < 1e-15 ? 0 : v / size;
  return {t, cross(n, t)};
}

}  // namespace dotyk::contact

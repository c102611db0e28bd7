#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/generators.hpp"
#include "mesh/second_order.hpp"

namespace dotyk::mesh {

std::vector<double> ticks(double a, double b, int n, const Grading& grading, const char* axis) {
  if (n < 1) throw InputError(text("cells along ", axis, " is ", n, "; it must be at least 1"));
  if (!(b > a))
    throw InputError(text("'to' must exceed 'from' along ", axis, " (from ", a, " to ", b, ")"));
  if (!std::isfinite(b - a))
    throw InputError(text("the extent along ", axis, ", from ", a, " to ", b, ", is beyond the range of numbers; choose another unit of length"));
  std::vector<double> t(n + 1);
  double before = -INFINITY;
  for (int i = 0; i <= n; ++i) {
    double s = static_cast<double>(i) / n;
    if (grading) s = grading(s);
    t[i] = i == 0 && !grading ? a : i == n && !grading ? b : a + (b - a) * s;
    if (!std::isfinite(t[i]) || !(s > before))
      throw InputError(text("grading.", axis, " must increase and be finite; at s = ",
                            static_cast<double>(i) / n, " it gives ", s));
    if (i > 0 && !(t[i] > t[i - 1]))
      throw InputError(text("the ", n, " cells along ", axis, ", from ", a, ", are so narrow that their nodes coincide in rounding; ",
                            "take fewer cells, or move them nearer to the origin"));
    before = s;
  }
  if (grading && (std::abs(t[0] - a) > 1e-9 * (b - a) || std::abs(t[n] - b) > 1e-9 * (b - a)))
    throw InputError(text("grading.", axis, " must map 0 to 0 and 1 to 1; it gives ",
                          (t[0] - a) / (b - a), " and ", (t[n] - a) / (b - a)));
  t[0] = a;
  t[n] = b;
  return t;
}

Mesh rectangle(const double from[2], const double to[2], const int cells[2], Family family,
               const Grading grading[2]) {
  const auto x = ticks(from[0], to[0], cells[0], grading[0], "x");
  const auto y = ticks(from[1], to[1], cells[1], grading[1], "y");
  const int nx = cells[0], ny = cells[1];
  Mesh mesh;
  const bool p1 = simplices(family);
  mesh.element = p1 ? Element::triangle_p1 : Element::quadrilateral_q1;
  mesh.coordinates.reserve(2 * x.size() * y.size());
  for (double yj : y)
    for (double xi : x) mesh.coordinates.insert(mesh.coordinates.end(), {xi, yj});
  const int per_cell = p1 ? 2 : 1;
  mesh.cells.reserve(static_cast<std::size_t>(nx) * ny * (p1 ? 6 : 4));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, d = a + nx + 1, c = d + 1;
      if (p1)
        mesh.cells.insert(mesh.cells.end(), {a, b, c, a, c, d});
      else
        mesh.cells.insert(mesh.cells.end(), {a, b, c, d});
    }
  // Local facets: lower triangle (bottom 0, right 1), upper triangle (top 1, left 2);
  // quadrilateral bottom 0, right 1, top 2, left 3.
  const auto cell_at = [&](int i, int j) { return per_cell * (j * nx + i); };
  for (int i = 0; i < nx; ++i) {
    mesh.parts["bottom"].push_back({cell_at(i, 0), 0});
    mesh.parts["top"].push_back({cell_at(i, ny - 1) + (p1 ? 1 : 0), p1 ? 1 : 2});
  }
  for (int j = 0; j < ny; ++j) {
    mesh.parts["left"].push_back({cell_at(0, j) + (p1 ? 1 : 0), p1 ? 2 : 3});
    mesh.parts["right"].push_back({cell_at(nx - 1, j), 1});
  }
  return of_family(std::move(mesh), family);
}

}  // namespace dotyk::mesh

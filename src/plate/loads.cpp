#include "plate/loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "algebra/dense/quadrature.hpp"
#include "base/error.hpp"

namespace dotyk::plate {

using algebra::Vector;
using Eigen::Vector2d;

Place Finder::find(const Vector2d& x, const std::string& what) const {
  if (const auto place = find(x)) return *place;
  throw InputError(text(what, " (", x[0], ", ", x[1], ") is not on the plate"));
}

std::optional<Place> Finder::find(const Vector2d& x) const {
  constexpr double kSlack = 1e-6;  // in barycentric coordinates
  Place best{-1, {}};
  double depth = -kSlack;
  for (const int c : cells_.around({x[0], x[1], 0})) {
    const Barycentric b = barycentric(triangle(*space_.mesh, space_.edges, c), x);
    if (!(b.minCoeff() >= depth)) continue;
    best = {c, b};
    depth = b.minCoeff();
  }
  if (best.cell < 0) return std::nullopt;
  return best;
}

namespace {

/// Along lines and sides.
const algebra::Quadrature& gauss3() {
  static const algebra::Quadrature three = algebra::gauss(3);
  return three;
}

void add(Vector& load, const Functional& functional, double force) {
  for (const Term& term : functional) load[term.freedom] += term.factor * force;
}

void add_distributed(const Plate& plate, const Space& space, Vector& load) {
  if (!plate.f_of && plate.f == 0) return;
  const Rule& rule = load_rule(space.element);
  for (int c = 0; c < space.mesh->cell_count(); ++c) {
    const Triangle t = triangle(*space.mesh, space.edges, c);
    const auto functions = basis(space.element, t);
    Values local = Values::Zero(functions->size());
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      double f = plate.f;
      if (plate.f_of) {
        const Vector2d x = t.point(rule.points[i]);
        f = plate.f_of(x[0], x[1]);
        if (!std::isfinite(f)) throw InputError(text("the load is ", f, " at (", x[0], ", ", x[1], "); it must be finite"));
      }
      local += rule.weights[i] * t.area * f * functions->value(rule.points[i]);
    }
    space.to_freedoms(c, local);
    const auto freedom = space.freedoms(c);
    for (int i = 0; i < space.local_size(); ++i) load[freedom[i]] += local[i];
  }
}

/// Adds where the line crosses a segment, as a part of its length.
void add_crossing(const Vector2d& from, const Vector2d& along, const Vector2d& a, const Vector2d& b, std::vector<double>& out) {
  const Vector2d segment = b - a, normal(segment[1], -segment[0]);
  const double towards = normal.dot(along);
  if (std::abs(towards) < 1e-12 * along.norm() * segment.norm()) return;
  const double s = normal.dot(a - from) / towards, t = segment.dot(from + s * along - a) / segment.squaredNorm();
  if (s > 0 && s < 1 && t > -1e-7 && t < 1 + 1e-7) out.push_back(s);
}

/// Where the line passes from one polynomial to another: at edges and, of HCT, between the thirds of cells; ascending, with 0 and 1.
std::vector<double> crossings(const Space& space, const Vector2d& from, const Vector2d& along) {
  std::vector<double> out{0, 1};
  for (const Edge& edge : space.edges.edges) add_crossing(from, along, edge.middle - edge.length / 2 * edge.tangent, edge.middle + edge.length / 2 * edge.tangent, out);
  for (int c = 0; space.element == Element::hct && c < space.mesh->cell_count(); ++c) {
    const Triangle t = triangle(*space.mesh, space.edges, c);
    for (const Vector2d& vertex : t.x) add_crossing(from, along, vertex, t.point(Barycentric::Constant(1. / 3)), out);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void add_line(const LineLoad& line, const Space& space, const Finder& finder, Vector& load) {
  const Vector2d from(line.from[0], line.from[1]), along = Vector2d(line.to[0], line.to[1]) - from;
  const auto at = crossings(space, from, along);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double part = at[i + 1] - at[i];
    if (part < 1e-12) continue;
    for (Eigen::Index g = 0; g < gauss3().points.size(); ++g) {
      const Place place = finder.find(from + (at[i] + gauss3().points[g] * part) * along, "a line load:");
      add(load, space.deflection_at(place.cell, place.at), line.force * gauss3().weights[g] * part * along.norm());
    }
  }
}

/// The L² projection of the load along a side on the linear functions: its values at the two ends. Nothing where the law is no load at one of Gauss's points.
std::optional<Vector2d> projected(const LawField& law, const std::string& part, const Space& space, const Edge& edge) {
  const Vector2d a = node_position(*space.mesh, edge.node[0]), along = node_position(*space.mesh, edge.node[1]) - a;
  double mean = 0, slope = 0;
  for (Eigen::Index g = 0; g < gauss3().points.size(); ++g) {
    const double t = gauss3().points[g];
    const problem::LawChoice at = law_at(law, part, a + t * along);  // x = 1 stays 1
    if (!at->load) return std::nullopt;
    mean += gauss3().weights[g] * at.force();
    slope += 3 * gauss3().weights[g] * (2 * t - 1) * at.force();
  }
  return Vector2d(mean - slope, mean + slope);
}

/// At a vertex of a part: the law's value there, and what acts about it.
struct VertexLoad {
  double value, force = 0;
};

}  // namespace

Vector loads(const Plate& plate, const Space& space) {
  Vector load = Vector::Zero(space.count());
  add_distributed(plate, space, load);
  if (plate.point_loads.empty() && plate.line_loads.empty() && plate.supports.empty()) return load;
  const Finder finder(space);
  const auto add_point = [&](double x, double y, double force, const char* what) {
    const Place place = finder.find({x, y}, what);
    add(load, space.deflection_at(place.cell, place.at), force);
  };
  for (const PointLoad& point : plate.point_loads) add_point(point.x, point.y, point.force, "a point load:");
  for (const PointSupport& s : plate.supports)
    if (s.deflection->load) add_point(s.x, s.y, s.deflection.force(), "a support:");
  for (const LineLoad& line : plate.line_loads) add_line(line, space, finder, load);
  return load;
}

void add_law_loads(const Plate& plate, const Space& space, std::vector<Sample>& deflections, std::vector<Sample>& rotations, Vector& load) {
    std::map<std::pair<int, int>, VertexLoad> loaded;  // by support and vertex
  for (const Sample& s : deflections)
    if (s.law->load) loaded[{s.support, s.place}] = {s.law.force()};
  for (int s = 0; s < static_cast<int>(plate.edges.size()) && !loaded.empty(); ++s)
    for (const mesh::Facet f : plate.edges[s].facets) {
      const int index = space.edges.of_cell[f.cell][f.local];
      const Edge& edge = space.edges.edges[index];
      const std::array ends{loaded.find({s, edge.node[0]}), loaded.find({s, edge.node[1]})};
      const bool both = ends[0] != loaded.end() && ends[1] != loaded.end();
      const auto linear = both ? projected(plate.edges[s].deflection, plate.edges[s].part, space, edge) : std::nullopt;
      for (int end = 0; end < 2; ++end) {
        if (ends[end] == loaded.end()) continue;
        VertexLoad& at = ends[end]->second;
        const double value = linear ? (*linear)[end] : at.value;
        add(load, space.mean_deflection(index, edge.node[end]), value);
        at.force += value * edge.length / 2;
      }
    }
  for (Sample& s : deflections)
    if (s.law->load) s.law.numbers[0] = loaded.at({s.support, s.place}).force / s.share;
  for (Sample& s : rotations) {
    if (!s.law->load) continue;
    const EdgeSupport& on = plate.edges[s.support];
    if (space.element == Element::morley)
      if (const auto linear = projected(on.rotation, on.part, space, space.edges.edges[s.place])) s.law.numbers[0] = linear->mean();
    add(load, rotation(space, s), s.law.force() * s.share);
  }
}

}  // namespace dotyk::plate

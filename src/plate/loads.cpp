#include "plate/loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"

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
  for (const int c : grid_.near({x[0], x[1], 0})) {
    const Barycentric b = barycentric(triangle(*space_.mesh, space_.edges, c), x);
    if (!(b.minCoeff() >= depth)) continue;
    best = {c, b};
    depth = b.minCoeff();
  }
  if (best.cell < 0) return std::nullopt;
  return best;
}

namespace {

void add(Vector& load, const Functional& functional, double force) {
  for (const Term& term : functional) load[term.freedom] += term.factor * force;
}

void add_distributed(const Plate& plate, const Space& space, Vector& load) {
  if (!plate.f_of && plate.f == 0) return;
  const Rule& rule = load_rule(space.element);
  for (int c = 0; c < space.mesh->cell_count(); ++c) {
    const Triangle t = triangle(*space.mesh, space.edges, c);
    const auto functions = basis(space.element, t);
    Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12> local = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 12>::Zero(functions->size());
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      double f = plate.f;
      if (plate.f_of) {
        const Vector2d x = t.point(rule.points[i]);
        f = plate.f_of(x[0], x[1]);
        if (!std::isfinite(f)) throw InputError(text("the load is ", f, " at (", x[0], ", ", x[1], "); it must be finite"));
      }
      local += rule.weights[i] * t.area * f * functions->value_at(rule.points[i]);
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
  const double root = std::sqrt(0.6) / 2, points[3] = {0.5 - root, 0.5, 0.5 + root}, weights[3] = {5. / 18, 8. / 18, 5. / 18};
  const auto at = crossings(space, from, along);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double part = at[i + 1] - at[i];
    if (part < 1e-12) continue;
    for (int g = 0; g < 3; ++g) {
      const Place place = finder.find(from + (at[i] + points[g] * part) * along, "a line load:");
      add(load, space.deflection_at(place.cell, place.at), line.force * weights[g] * part * along.norm());
    }
  }
}

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
    if (s.deflection.kind == problem::SupportLaw::Kind::load) add_point(s.x, s.y, s.deflection.value, "a support:");
  for (const LineLoad& line : plate.line_loads) add_line(line, space, finder, load);
  return load;
}

namespace {

/// Of a load on an edge, by s from −1 to 1: mean + slope s is its L² projection on the linear functions.
struct LinearLoad {
  double mean, slope;
};

/// By Gauss's rule of three points; nothing where the law is no load at one of these.
std::optional<LinearLoad> projected(const LawField& law, const std::string& part, const Space& space, const Edge& edge) {
  const double root = std::sqrt(0.6);
  const Vector2d a = node_position(*space.mesh, edge.node[0]), along = node_position(*space.mesh, edge.node[1]) - a;
  LinearLoad out{0, 0};
  for (const auto& [s, weight] : {std::pair(-root, 5. / 18), {0., 8. / 18}, {root, 5. / 18}}) {
    const problem::SupportLaw at = law_at(law, part, a + (1 + s) / 2 * along);  // x = 1 stays 1
    if (at.kind != problem::SupportLaw::Kind::load) return std::nullopt;
    out.mean += weight * at.value;
    out.slope += 3 * weight * s * at.value;
  }
  return out;
}

/// The loads of a side at its ends: their linear course between does the load's work on every linear deflection. Where the law is no load all
/// along, its values at those ends where it is one.
Vector2d at_ends(const EdgeSupport& on, const Space& space, const Edge& edge) {
  Vector2d out(0, 0);
  bool all = true;
  for (int end = 0; end < 2; ++end) {
    const problem::SupportLaw at = law_at(on.deflection, on.part, node_position(*space.mesh, edge.node[end]));
    if (at.kind == problem::SupportLaw::Kind::load) out[end] = at.value;
    else all = false;
  }
  if (const auto linear = all ? projected(on.deflection, on.part, space, edge) : std::nullopt) out = {linear->mean - linear->slope, linear->mean + linear->slope};
  return out;
}

}  // namespace

void add_law_loads(const Plate& plate, const Space& space, std::vector<Sample>& deflections, std::vector<Sample>& rotations, Vector& load) {
  std::map<std::pair<int, int>, double> forces;  // by support and vertex
  for (std::size_t s = 0; s < plate.edges.size(); ++s) {
    const EdgeSupport& on = plate.edges[s];
    if (!on.deflection) continue;
    for (const mesh::Facet f : on.facets) {
      const int index = space.edges.of_cell[f.cell][f.local];
      const Edge& edge = space.edges.edges[index];
      const Vector2d values = at_ends(on, space, edge);
      for (int end = 0; end < 2; ++end) {
        if (values[end] == 0) continue;
        add(load, space.mean_deflection(index, edge.node[end]), values[end]);
        forces[{static_cast<int>(s), edge.node[end]}] += values[end] * edge.length / 2;
      }
    }
  }
  for (Sample& s : deflections)
    if (s.law.kind == problem::SupportLaw::Kind::load) s.law.value = forces[{s.support, s.place}] / s.share;
  for (Sample& s : rotations) {
    if (s.law.kind != problem::SupportLaw::Kind::load) continue;
    const EdgeSupport& on = plate.edges[s.support];
    if (space.element == Element::morley)
      if (const auto linear = projected(on.rotation, on.part, space, space.edges.edges[s.place])) s.law.value = linear->mean;
    add(load, rotation(space, s), s.law.value * s.share);
  }
}

}  // namespace dotyk::plate

#include "figure/scene/contact_map.hpp"

#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/error.hpp"
#include "figure/canvas/geometry.hpp"

namespace dotyk::figure {

namespace {

constexpr double kAlong = 0.05;  // a normal is across a direction, or along an axis, within this

// Where the nodes are on the map, and which way is across and up at each of them.
struct Flat {
  std::vector<Point> at;
  std::vector<Vec3> across, up;
  std::array<std::string, 2> names;
  double period = 0;  // of a closed surface, across or up
  bool period_up = false;
};

// The axis that a direction is along: 0 to 2, or none.
std::optional<std::size_t> axis_of(const Vec3& direction) {
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(direction[c]) > 1 - 1e-4) return c;
  return std::nullopt;
}

std::string name_of(const Vec3& direction, const char* otherwise) {
  const auto axis = axis_of(direction);
  return axis ? std::string(1, "xyz"[*axis]) : otherwise;
}

// So that its greatest component is positive.
Vec3 forwards(const Vec3& d) {
  std::size_t most = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(d[c]) > (1 + 1e-9) * std::abs(d[most])) most = c;
  return d[most] < 0 ? plus({0, 0, 0}, d, -1) : d;
}

Vec3 mean_normal(const ContactPicture& contact, bool by_pressure) {
  Vec3 mean{0, 0, 0};
  for (const ContactNode& node : contact.nodes) mean = plus(mean, node.normal, (node.weight > 0 ? node.weight : 1) * (by_pressure ? node.pressure : 1));
  return unit(mean);
}

// Two directions across the normal; along axes where its component along one is more than `nearly`.
std::array<Vec3, 2> directions_across(const Vec3& normal, double nearly) {
  std::size_t most = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(normal[c]) > (1 + 1e-9) * std::abs(normal[most])) most = c;
  if (std::abs(normal[most]) > nearly || length(normal) == 0) {
    std::array<Vec3, 2> along{};
    along[0][most == 0 ? 1 : 0] = 1, along[1][most == 2 ? 1 : 2] = 1;
    return along;
  }
  const Vec3 vertical = std::abs(normal[2]) > 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 across = forwards(unit(cross(vertical, normal)));
  return {across, forwards(unit(cross(normal, across)))};
}

bool is_flat(const ContactPicture& contact) {
  const Vec3 first = unit(contact.nodes.front().normal);
  return std::ranges::all_of(contact.nodes, [&](const ContactNode& node) { return length(cross(first, unit(node.normal))) < kAlong; });
}

Flat seen_along(const ContactPicture& contact, const Vec3& normal) {
  // What is curved is not seen in true size anyway.
  const auto [across, up] = directions_across(normal, is_flat(contact) ? 0.9999 : 0.7);
  Flat flat;
  for (const ContactNode& node : contact.nodes) flat.at.push_back({dot(node.position, across), dot(node.position, up)});
  flat.across.assign(contact.nodes.size(), across), flat.up.assign(contact.nodes.size(), up);
  flat.names = {name_of(across, "s"), name_of(up, "t")};
  return flat;
}

// The direction of the straight lines of the surface: that across all normals, which are not all one.
std::optional<Vec3> direction_of_lines(const ContactPicture& contact) {
  const Vec3 first = unit(contact.nodes.front().normal);
  Vec3 sum{0, 0, 0};
  for (const ContactNode& node : contact.nodes) {
    const Vec3 c = cross(first, unit(node.normal));
    sum = plus(sum, c, dot(sum, c) < 0 ? -1 : 1);
  }
  const Vec3 lines = forwards(unit(sum));
  const bool across = std::ranges::all_of(contact.nodes, [&](const ContactNode& node) { return std::abs(dot(unit(node.normal), lines)) < kAlong; });
  return is_flat(contact) || !across ? std::nullopt : std::optional(lines);
}

// Lengths along a profile that is a graph over the coordinate t, height h; from its middle.
std::vector<double> lengths_along(const std::vector<Point>& profile) {
  std::vector<std::size_t> order(profile.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return profile[i].x; });
  std::vector<double> out(profile.size());
  double way = 0;
  for (std::size_t k = 1; k < order.size(); ++k) out[order[k]] = way += length(profile[order[k]] - profile[order[k - 1]]);
  for (double& s : out) s -= way / 2;
  return out;
}

struct Circle {
  Point centre;
  double radius = 0;
};

// Through points about it, by least squares of |p - c|² - r² (Kåsa 1976); none where they are not on a circle within 3 % of its radius.
std::optional<Circle> circle_through(const std::vector<Point>& points) {
  Point mean;
  for (const Point& p : points) mean = mean + 1.0 / static_cast<double>(points.size()) * p;
  double uu = 0, uv = 0, vv = 0, pu = 0, pv = 0, square = 0;
  for (const Point& p : points) {
    const Point d = p - mean;
    const double s = d.x * d.x + d.y * d.y;
    uu += d.x * d.x, uv += d.x * d.y, vv += d.y * d.y, pu += d.x * s / 2, pv += d.y * s / 2, square += s;
  }
  const double determinant = uu * vv - uv * uv;
  if (!(std::abs(determinant) > 1e-12 * square * square)) return std::nullopt;
  const Point c{(pu * vv - pv * uv) / determinant, (pv * uu - pu * uv) / determinant};
  const Circle circle{mean + c, std::sqrt(c.x * c.x + c.y * c.y + square / static_cast<double>(points.size()))};
  const bool on = std::ranges::all_of(points, [&](Point p) { return std::abs(length(p - circle.centre) - circle.radius) < 0.03 * circle.radius; });
  return on ? std::optional(circle) : std::nullopt;
}

// The middle of an open arc of points: the direction from the centre that is opposite to the widest gap. `otherwise`, if that is not much wider than most.
double opposite_of_gap(const std::vector<Point>& points, Point centre, double otherwise) {
  constexpr double kWider = 3, kSame = 1e-6;
  std::vector<double> angles, gaps;
  for (const Point& p : points) angles.push_back(std::atan2(p.y - centre.y, p.x - centre.x));
  std::ranges::sort(angles);
  double widest = 0, middle = 0;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double next = k + 1 < angles.size() ? angles[k + 1] : angles[0] + 2 * std::numbers::pi, gap = next - angles[k];
    if (gap > kSame) gaps.push_back(gap);
    if (gap > widest) widest = gap, middle = (angles[k] + next) / 2;
  }
  if (gaps.empty()) return otherwise;
  std::ranges::nth_element(gaps, gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2));
  return widest > kWider * gaps[gaps.size() / 2] ? middle + std::numbers::pi : otherwise;
}

// A surface of straight lines, unrolled; none where its profile is neither a graph seen along the mean normal nor on a circle.
std::optional<Flat> unrolled(const ContactPicture& contact, const Vec3& lines) {
  Vec3 middle = mean_normal(contact, false);
  const bool graph = std::ranges::all_of(contact.nodes, [&](const ContactNode& node) { return dot(unit(node.normal), middle) > kAlong; });
  if (const Vec3 pressed = mean_normal(contact, true); !graph && length(pressed) > 0) middle = pressed;
  middle = unit(plus(middle, lines, -dot(middle, lines)));
  if (length(middle) == 0) middle = unit(contact.nodes.front().normal);
  const Vec3 t = forwards(unit(cross(lines, middle)));
  std::vector<Point> profile;
  for (const ContactNode& node : contact.nodes) profile.push_back({dot(node.position, t), dot(node.position, middle)});
  std::vector<double> arc;
  Flat flat;
  if (graph) {
    arc = lengths_along(profile);
  } else {
    const std::optional<Circle> circle = circle_through(profile);
    if (!circle) return std::nullopt;
    const double side = dot(unit(contact.nodes.front().normal), plus(plus({0, 0, 0}, t, profile[0].x - circle->centre.x), middle, profile[0].y - circle->centre.y)) < 0 ? -1 : 1;
    const auto from_middle = [&](Point p) { return std::atan2(p.x - circle->centre.x, side * (p.y - circle->centre.y)); };
    const double direction = opposite_of_gap(profile, circle->centre, side * std::numbers::pi / 2), zero = from_middle(circle->centre + Point{std::cos(direction), std::sin(direction)});
    for (const Point& p : profile) {
      const double angle = std::remainder(from_middle(p) - zero, 2 * std::numbers::pi);
      arc.push_back(circle->radius * (angle > (1 - 1e-9) * std::numbers::pi ? -std::numbers::pi : angle));  // at the cut, where rounding decides
    }
    flat.period = 2 * std::numbers::pi * circle->radius;
  }
  std::vector<double> along;
  for (const ContactNode& node : contact.nodes) along.push_back(dot(node.position, lines));
  const auto extent = [](const std::vector<double>& values) { return std::ranges::max(values) - std::ranges::min(values); };
  const bool lines_up = extent(along) < extent(arc);  // pictures are broad
  for (std::size_t i = 0; i < arc.size(); ++i) {
    // At the middle the arc runs along t.
    const Vec3 tangent = plus({0, 0, 0}, unit(cross(lines, contact.nodes[i].normal)), dot(cross(lines, middle), t) < 0 ? -1 : 1);
    flat.at.push_back(lines_up ? Point{arc[i], along[i]} : Point{along[i], arc[i]});
    flat.across.push_back(lines_up ? tangent : lines), flat.up.push_back(lines_up ? lines : tangent);
  }
  const std::string name = name_of(lines, "along");
  flat.names = lines_up ? std::array<std::string, 2>{"arc", name} : std::array<std::string, 2>{name, "arc"};
  flat.period_up = !lines_up;
  return flat;
}

// Whether a part of the surface faces away from the mean normal: seen along that, the map would cover itself.
bool turns_away(const ContactPicture& contact) {
  constexpr double kBehind = -0.2;
  const Vec3 mean = mean_normal(contact, false);
  return std::ranges::any_of(contact.nodes, [&](const ContactNode& node) { return dot(unit(node.normal), mean) < kBehind; });
}

std::optional<Flat> flattened(const ContactPicture& contact) {
  if (const std::optional<Vec3> lines = direction_of_lines(contact))
    if (std::optional<Flat> flat = unrolled(contact, *lines)) return flat;
  if (turns_away(contact)) return std::nullopt;
  return seen_along(contact, mean_normal(contact, false));
}

// Facets across the cut of a closed surface get the nodes on its one side once more on the other.
void close(Flat& flat, ContactPicture& contact) {
  if (flat.period == 0) return;
  double Point::*along = flat.period_up ? &Point::y : &Point::x;
  std::map<int, int> again;
  const auto each = static_cast<std::size_t>(contact.nodes_per_facet);
  for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
    const auto arc = [&](std::size_t k) { return flat.at[contact.facets[f + k]].*along; };
    double most = arc(0);
    for (std::size_t k = 1; k < each; ++k) most = std::max(most, arc(k));
    for (std::size_t k = 0; k < each; ++k) {
      int& node = contact.facets[f + k];
      if (most - flat.at[node].*along < flat.period / 2) continue;
      const auto [found, fresh] = again.try_emplace(node, static_cast<int>(contact.nodes.size()));
      if (fresh) {
        contact.nodes.push_back(ContactNode(contact.nodes[node]));
        if (!contact.values.empty()) contact.values.push_back(double(contact.values[node]));
        flat.at.push_back(Point(flat.at[node]));
        flat.at.back().*along += flat.period;
        flat.across.push_back(Vec3(flat.across[node])), flat.up.push_back(Vec3(flat.up[node]));
      }
      node = found->second;
    }
  }
}

}  // namespace

bool has_map(const ContactPicture& contact) { return !contact.facets.empty() && contact.nodes_per_facet > 2 && flattened(contact); }

ScenePicture contact_map(const ContactPicture& given) {
  if (given.facets.empty() || given.nodes_per_facet < 3) throw InputError("contact \"" + given.name + "\" has no surface that a map could show");
  std::optional<Flat> found = flattened(given);
  if (!found) throw InputError("contact \"" + given.name + "\" is closed and not a cylinder: a map of it would lie upon itself; make contacts of its sides");
  Flat& flat = *found;
  ScenePicture map;
  ContactPicture& contact = map.contacts.emplace_back(given);
  close(flat, contact);
  BodyPicture& body = map.bodies.emplace_back();
  body.name = contact.name;
  body.shape = contact.nodes_per_facet == 3 ? CellShape::triangle : CellShape::quad;
  body.values = std::exchange(contact.values, {});
  if (!body.values.empty()) body.cells = contact.facets;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    ContactNode& node = contact.nodes[i];
    node.shear = {dot(node.shear, flat.across[i]), dot(node.shear, flat.up[i]), 0};
    node.position = {flat.at[i].x, flat.at[i].y, 0}, node.displacement = {0, 0, 0}, node.normal = {0, 0, 1};
    body.points.insert(body.points.end(), node.position.begin(), node.position.end());
  }
  map.axis_names = flat.names;
  return map;
}

}  // namespace dotyk::figure

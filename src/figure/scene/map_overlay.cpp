// On the map of a contact: statuses, pressure, shear.
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double map_marker = 0.42, map_spacing = 1.5, longest_arrow = 1.3;  // em

// Open parts are pale.
Colour map_colour(Status status) {
  const Colour c = status_colour(status);
  const auto pale = [](unsigned char value) { return static_cast<unsigned char>(255 - (255 - value) / 4); };
  return status == Status::open ? Colour{pale(c.r), pale(c.g), pale(c.b)} : c;
}

void fill_statuses(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at) {
  std::vector<std::array<Point, 4>> slipping;
  each_polygon({contact.facets, contact.nodes_per_facet}, [&](std::span<const int> facet) {
    std::vector<Point> corner;
    for (const int i : facet) corner.push_back(at[i]);
    const auto parts = quarters(corner);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Colour colour = map_colour(contact.nodes[facet[k]].status);
      stage.over.convex(parts[k], colour);
      stage.over.polyline(parts[k], 1, colour, {}, true);  // so that no seams show between them
      if (contact.nodes[facet[k]].status == Status::slip) slipping.push_back(parts[k]);
    }
  });
  for (const auto& part : slipping) hatch_slip(stage.over, cropped(std::vector<Point>(part.begin(), part.end()), stage.frame.grown(stage.em)), stage.em);
}

// Lines between nodes of different statuses, half way.
void draw_borders(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at) {
  const double width = std::max(1.4, stage.em / 11);
  for (const bool rim : {true, false})
    each_polygon({contact.facets, contact.nodes_per_facet}, [&](std::span<const int> facet) {
      std::vector<Point> corner;
      for (const int i : facet) corner.push_back(at[i]);
      const auto parts = quarters(corner);
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (contact.nodes[facet[k]].status != contact.nodes[facet[(k + 1) % parts.size()]].status)
          stage.over.line(parts[k][1], parts[k][2], rim ? 2 * width : width, rim ? Colour{255, 255, 255} : axes_ink);
    });
}

std::vector<std::size_t> apart(const Stage& stage, const std::vector<Point>& at, double spacing) {
  std::vector<Point> seen;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (stage.shows(at[i], 0.3 * stage.em)) seen.push_back(at[i]), numbers.push_back(i);
  std::vector<std::size_t> out = spread(seen, seen, spacing);
  for (std::size_t& i : out) i = numbers[i];
  return out;
}

// Nodes of one status that hang together.
std::vector<std::vector<std::size_t>> regions(const ContactPicture& contact) {
  std::vector<std::size_t> root(contact.nodes.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::vector<bool> used(contact.nodes.size(), false);
  for (const auto& [a, b] : pairs(unique_edges({contact.facets, contact.nodes_per_facet}))) {
    used[a] = used[b] = true;
    if (contact.nodes[a].status == contact.nodes[b].status) root[find(a)] = find(b);
  }
  std::map<std::size_t, std::vector<std::size_t>> by_root;
  for (std::size_t i = 0; i < root.size(); ++i)
    if (used[i]) by_root[find(i)].push_back(i);
  std::vector<std::vector<std::size_t>> out;
  for (auto& [i, nodes] : by_root) out.push_back(std::move(nodes));
  return out;
}

// On a field statuses are told by markers, and by lines between them. A region without a marker gets one at the node nearest to its middle, if possible
// at a node that no arrow covers; else an arrow gives way to it.
void draw_markers(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, std::vector<Segment>& arrows) {
  const auto covers = [&](const Segment& arrow, std::size_t i) {
    return distance(arrow, at[i]) < 0.45 * map_marker * stage.em || length(arrow[1] - at[i]) < 0.5 * (map_marker + shear_head) * stage.em;
  };
  const auto covered = [&](std::size_t i) { return std::ranges::any_of(arrows, [&](const Segment& arrow) { return covers(arrow, i); }); };
  std::vector<std::size_t> marked = apart(stage, at, map_spacing * stage.em);
  std::erase_if(marked, covered);
  const std::set<std::size_t> spaced(marked.begin(), marked.end());
  for (const std::vector<std::size_t>& region : regions(contact)) {
    if (std::ranges::any_of(region, [&](std::size_t i) { return spaced.contains(i); })) continue;
    Bounds bounds;
    std::vector<std::size_t> seen;
    for (const std::size_t i : region)
      if (stage.shows(at[i], 0.3 * stage.em)) seen.push_back(i), bounds.add(at[i]);
    if (const auto hidden = std::ranges::stable_partition(seen, std::not_fn(covered)); hidden.begin() != seen.begin()) seen.erase(hidden.begin(), hidden.end());
    if (seen.empty()) continue;
    marked.push_back(*std::ranges::min_element(seen, {}, [&](std::size_t i) { return length(at[i] - bounds.centre()); }));
    if (arrows.size() > 1) std::erase_if(arrows, [&](const Segment& arrow) { return covers(arrow, marked.back()); });
  }
  for (const std::size_t i : marked) {
    const Status status = contact.nodes[i].status;
    stage.over.marker(status_marker(status), at[i], map_marker * stage.em, status_colour(status));
    stage.tell(status_name(status), std::array{at[i]});
  }
}

// Discs whose area is the pressure.
void draw_pressure(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at) {
  if (!(stage.greatest_pressure > 0) || !stage.pressures()) return;
  const double spacing = 0.55 * stage.em;
  for (const std::size_t i : apart(stage, at, spacing)) {
    const double share = contact.nodes[i].pressure / stage.greatest_pressure;
    if (share > 0.002) stage.over.disc(at[i], 0.45 * spacing * std::sqrt(share), pressure_line);
  }
}

}  // namespace

void hatch_slip(Canvas& canvas, std::span<const Point> polygon, double em) {
  for (const auto& [p, q] : hatched(polygon, slip_spacing * em)) canvas.line(p, q, slip_line * em, slip_hatch);
}

void draw_contact_map(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = stage.at(contact.nodes);
  const bool field = stage.scale.shown;
  if (!field) fill_statuses(stage, contact, at);
  for (const auto& [a, b] : pairs(rim({contact.facets, contact.nodes_per_facet}))) stage.over.line(at[a], at[b], std::max(1.2, stage.em / 18), axes_ink);
  field ? draw_borders(stage, contact, at) : draw_pressure(stage, contact, at);
  // From the nodes, or from the rims of markers there.
  std::vector<Segment> arrows = shear_arrows(stage, contact, at, map_spacing * stage.em, [&](std::size_t i) {
    const Point shear{contact.nodes[i].shear[0], contact.nodes[i].shear[1]}, tail = at[i] + (field ? 0.5 * map_marker * stage.em / std::max(length(shear), 1e-300) : 0) * shear;
    return Segment{tail, tail + shear_scale(stage, longest_arrow) * shear};
  });
  if (field) draw_markers(stage, contact, at, arrows);
  draw_shear(stage, arrows);
}

LegendEntry map_status_entry(const Stage& stage, Status status) {
  return {status_name(status), [em = stage.em, colour = status_colour(status), status, field = stage.scale.shown](Canvas& c, const Box& b) {
            if (field) return c.marker(status_marker(status), b.centre(), map_marker * em, colour);
            const Box sample = Box::about(b.centre(), {std::min(1.2 * em, 0.8 * b.width()), 0.7 * em});
            c.box(sample, map_colour(status));
            if (status == Status::slip) hatch_slip(c, sample.corners(), em);
          }};
}

}  // namespace dotyk::figure

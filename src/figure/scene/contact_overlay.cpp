// What happens on the contact boundary: status, pressure and shear.
#include <iterator>
#include <set>

#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour rim_colour{255, 255, 255};

std::vector<std::size_t> seen_of(const Stage& stage, const std::vector<Point>& at, double within = 0) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (stage.shows(at[i], within)) out.push_back(i);
  return out;
}

void draw_strip(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = stage.at(contact.nodes);
  std::vector<Point> tops;
  for (const ContactNode& node : contact.nodes) tops.push_back(pressure_tip(stage, node));
  const double width = std::max(1.2, stage.em / 14);
  const auto loaded = [&](std::size_t i) { return contact.nodes[i].pressure > 0; };
  for (const bool fill : {true, false})
    for (const auto& [a, b] : pairs(contact.facets)) {
      if (!loaded(a) && !loaded(b)) continue;
      if (fill) {
        stage.over.convex(std::array{at[a], at[b], tops[b], tops[a]}, pressure_fill, 0.72);
      } else {
        stage.over.line(tops[a], tops[b], width, pressure_line);
        for (const int i : {a, b}) stage.over.disc(tops[i], width / 2, pressure_line);
      }
    }
  for (const std::size_t i : stage.spaced(at, 0.55 * stage.em))
    if (loaded(i)) stage.over.line(at[i], tops[i], std::max(0.8, stage.em / 30), pressure_line, 0.6);
  for (const std::size_t i : seen_of(stage, at))
    if (loaded(i)) stage.tell("pressure", Segment{at[i], tops[i]});
}

void draw_arrows(Stage& stage, const ContactPicture& contact) {
  if (!(stage.greatest_pressure > 0)) return;
  const std::vector<Point> at = stage.at(contact.nodes);
  const auto pressure = [&](std::size_t i) { return contact.nodes[i].pressure; };
  for (const std::size_t i : spread(at, seen_of(stage, at), pressure, 0.8 * stage.em)) {
    if (pressure(i) < 0.02 * stage.greatest_pressure) continue;
    const Point tip = pressure_tip(stage, contact.nodes[i]);
    stage.over.arrow(tip, at[i], std::max(1.2, stage.em / 14), 0.42 * stage.em, pressure_line, std::max(0.8, stage.em / 30));
    stage.tell("pressure", Segment{at[i], tip});
  }
}

// Too short for markers: a joint of one brick among hundreds.
bool is_short(const Stage& stage, const ContactPicture& contact) {
  Bounds bounds;
  for (const Point& p : stage.at(contact.nodes)) bounds.add(p);
  return !bounds.empty() && std::hypot(bounds.width(), bounds.height()) < 4 * stage.em;
}

constexpr double wide = 0.26, thin = 0.15;  // lines with markers and without, in em

// Nodes of one status that follow each other along a contact line, and how long that is in pixels, to half way to their neighbours.
struct Run {
  std::vector<int> nodes;
  double length = 0;
};

std::vector<Run> runs(const ContactPicture& contact, const std::vector<Point>& at) {
  std::vector<Run> out;
  for (const std::vector<int>& chain : chains(contact.facets)) {
    const std::size_t first = out.size();
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const double half = k == 0 ? 0 : length(at[chain[k]] - at[chain[k - 1]]) / 2;
      if (k > 0) out.back().length += half;
      if (k == 0 || contact.nodes[chain[k]].status != contact.nodes[chain[k - 1]].status) out.emplace_back();
      out.back().nodes.push_back(chain[k]);
      out.back().length += half;
    }
    // Of a closed line the last one goes on in the first.
    if (chain.front() != chain.back() || out.size() < first + 2 || contact.nodes[out[first].nodes[0]].status != contact.nodes[out.back().nodes[0]].status) continue;
    std::ranges::copy(out[first].nodes, std::back_inserter(out.back().nodes));
    out.back().length += out[first].length;
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return out;
}

constexpr double marker_size = 0.55, least_marker = 0.3;  // em

// Does any run of one status get a marker?
bool is_marked(const Stage& stage, const ContactPicture& contact) {
  return !is_short(stage, contact) || std::ranges::any_of(runs(contact, stage.at(contact.nodes)), [&](const Run& run) { return run.length >= least_marker * stage.em; });
}

// Where the status changes between two nodes, as a share of the way: where the drawn pressure reaches zero, if one of them is open; else half way.
double border(const ContactPicture& contact, const ContactNode& a, const ContactNode& b) {
  const bool open = a.status == Status::open;
  if (open == (b.status == Status::open) || std::ranges::none_of(contact.nodes, [](const ContactNode& n) { return n.pressure > 0; })) return 0.5;
  return ((open ? b : a).pressure > 0) != open ? 1 : 0;
}

// A marker of a node, as large as there is room for.
struct NodeMarker {
  const ContactNode* node;
  double size;  // em
};

// Each part of a facet in the colour of its node. Returns the markers that belong on it.
std::vector<NodeMarker> draw_line(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = stage.at(contact.nodes);
  const bool markers = !is_short(stage, contact);
  const double width = (markers ? wide : thin) * stage.em;
  for (const bool rim : {true, false})
    for (const auto& [a, b] : pairs(contact.facets))
      for (const int i : {a, b}) {
        const ContactNode &own = contact.nodes[i], &other = contact.nodes[i == a ? b : a];
        if (own.covered) continue;
        const bool whole = !other.covered && (rim || own.status == other.status);  // halves of one colour would show a seam
        const Colour colour = rim ? rim_colour : status_colour(own.status);
        const double w = rim ? 1.5 * width : width;
        const Segment part{at[i], whole ? at[b] : part_way(at[a], at[b], other.covered ? 0.5 : border(contact, contact.nodes[a], contact.nodes[b]))};
        if (!whole || i == a) stage.over.line(part[0], part[1], w, colour);
        if (!rim && (!whole || i == a)) stage.tell(status_name(own.status), part);
        stage.over.disc(at[i], w / 2, colour);
      }
  std::set<std::size_t> marked;
  if (markers)
    for (const std::size_t i : spread(at, seen_of(stage, at, 0.36 * stage.em), [&](std::size_t k) { return contact.nodes[k].pressure; }, 0.95 * stage.em)) marked.insert(i);
  std::vector<NodeMarker> out;
  for (const std::size_t i : marked)
    if (!contact.nodes[i].covered) out.push_back({&contact.nodes[i], marker_size});
  // Each run of one status keeps a marker, as large as there is room for but still legible, unless it would lie on another of these.
  std::vector<Point> small;
  for (const Run& run : runs(contact, at)) {
    const std::size_t middle = run.nodes[run.nodes.size() / 2];
    const double size = std::clamp(run.length / stage.em, least_marker, marker_size);
    if (!markers && run.length < least_marker * stage.em) continue;
    if (contact.nodes[middle].covered || !stage.shows(at[middle], 0.36 * stage.em) || std::ranges::any_of(run.nodes, [&](int i) { return marked.contains(i); })) continue;
    if (std::ranges::any_of(small, [&](Point p) { return length(p - at[middle]) < size * stage.em; })) continue;
    out.push_back({&contact.nodes[middle], size});
    small.push_back(at[middle]);
  }
  return out;
}

// A magnification draws the sides of a closed contact of two bodies apart, or into each other, by m − 1 times their gap
// at rest: a band in the colour of the status joins what touches.
void draw_joint(Stage& stage, const ContactPicture& contact) {
  const auto across = [&](const ContactNode& node) {
    return stage.view.flat(plus(stage.place(node), node.normal, (1 - stage.picture.deformation) * node.rest_gap));
  };
  for (const auto& [i, j] : pairs(contact.facets)) {
    const ContactNode &a = contact.nodes[i], &b = contact.nodes[j];
    const double share = border(contact, a, b);
    const Point own = part_way(stage.at(a), stage.at(b), share), other = part_way(across(a), across(b), share);
    for (const ContactNode* node : {&a, &b})
      if (node->status != Status::open && node->rest_gap != 0)
        stage.over.convex(std::array{stage.at(*node), own, other, across(*node)}, status_colour(node->status), 0.45);
  }
}

LegendEntry status_entry(const Stage& stage, Status status) {
  const auto& contacts = stage.picture.contacts;
  const bool markers = std::any_of(contacts.begin(), contacts.end(), [&](const ContactPicture& c) { return is_marked(stage, c); });
  const Colour colour = status_colour(status);
  if (stage.map()) return map_status_entry(stage, status);
  if (stage.plane)
    return {status_name(status), [=, em = stage.em](Canvas& c, const Box& b) {
              c.line(b.midline()[0], b.midline()[1], (markers ? wide : thin) * em, colour);
              if (markers) c.marker(status_marker(status), b.centre(), 0.55 * em, colour);
            }};
  return {status_name(status), [=, em = stage.em](Canvas& c, const Box& b) {
            const double middle = b.centre().y;
            const double half = std::min(0.6 * em, 0.4 * b.width());
            const Box sample{b.centre().x - half, middle - 0.35 * em, b.centre().x + half, middle + 0.35 * em};
            status == Status::open ? c.outline(sample, 0.16 * em, colour) : c.box(sample, colour);
            if (status == Status::slip) hatch_slip(c, sample.corners(), em);
          }};
}

// As a strip with an ordinate at each node, as arrows, or as dots on a map. In the plane the greatest is written beside it.
LegendEntry pressure_entry(const Stage& stage) {
  const bool map = stage.map();
  if (stage.strips() && !map)
    return {"contact pressure", [em = stage.em](Canvas& c, const Box& b) {
              const double low = b.centre().y - 0.3 * em, w = b.width();
              std::array<Point, 9> hill;
              for (std::size_t i = 0; i < hill.size(); ++i) {
                const double t = static_cast<double>(i) / 8;
                hill[i] = {b.left + w * t, low + 0.7 * em * std::sqrt(std::max(0.0, 4 * t * (1 - t)))};
              }
              c.convex(hill, pressure_fill, 0.9);
              c.polyline(hill, std::max(1.2, em / 14), pressure_line);
            }};
  const std::string name = stage.plane && !map ? "contact pressure" : at_most("contact pressure", stage.greatest_pressure, stage.picture.pressure_unit) + (stage.sharp ? singular_edge : "");
  return {name, [em = stage.em, arrow = !map, dots = map || stage.inset](Canvas& c, const Box& b) {
            const double x = b.centre().x - (arrow && dots ? 0.4 * em : 0);
            if (arrow) c.arrow({x, b.top - 0.1 * em}, {x, b.bottom + 0.1 * em}, std::max(1.2, em / 14), 0.42 * em, pressure_line);
            if (dots) c.disc({x + (arrow ? 0.9 * em : 0), b.centre().y}, 0.24 * em, pressure_line);
          }};
}

LegendEntry shear_entry(const Stage& stage) {
  return {at_most("shear", stage.greatest_shear, stage.picture.pressure_unit), [em = stage.em](Canvas& c, const Box& b) {
            const auto [from, to] = b.midline();
            c.arrow({from.x + 0.1 * em, from.y}, {to.x - 0.1 * em, to.y}, std::max(1.4, em / 11), 0.42 * em, shear_line);
          }};
}

// "open and slip", "open, stick and slip".
std::string listed(const std::set<Status>& statuses) {
  std::string out;
  std::size_t k = 0;
  for (const Status status : statuses) {
    out += (k == 0 ? "" : k + 1 == statuses.size() ? " and " : ", ") + std::string(status_name(status));
    ++k;
  }
  return out;
}

void contact_legend(const Stage& stage, std::vector<LegendEntry>& out) {
  std::set<Status> present;
  for (const ContactPicture& contact : stage.picture.contacts) {
    const std::vector<bool> seen = stage.shown(contact);
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i]) present.insert(contact.nodes[i].status);
  }
  if (stage.colours_contacts() && present.size() > 1)
    out.push_back({"border of " + listed(present), [em = stage.em](Canvas& c, const Box& b) {
                     c.line(b.midline()[0], b.midline()[1], 0.3 * em, {150, 150, 150});
                     c.line(b.midline()[0], b.midline()[1], 0.16 * em, {255, 255, 255});
                   }});
  if (stage.colours_contacts() && stage.inset) {
    std::set<Status> on_map;
    for (const ContactNode& node : stage.inset->contacts.front().nodes) on_map.insert(node.status);
    for (const Status status : on_map) out.push_back(map_status_entry(stage, status));
  }
  if (!stage.colours_contacts())
    for (const Status status : present) out.push_back(status_entry(stage, status));
  const bool in_colours = stage.colours_contacts() || (stage.map() && stage.scale.shown);
  if (stage.greatest_pressure > 0 && stage.pressures() && !in_colours) out.push_back(pressure_entry(stage));
  const auto rubs = [&](const ContactPicture& contact) { return !line_shear(stage, contact).empty(); };
  const bool shear = stage.plane && !stage.map() ? std::ranges::any_of(stage.picture.contacts, rubs) : stage.plane || stage.inset;
  if (stage.greatest_shear > 0 && shear) out.push_back(shear_entry(stage));
}

// In space, and on maps, the legend says the greatest pressure.
std::vector<Label> labels(const Stage& stage) {
  std::vector<Label> out;
  if (stage.pressures() && stage.plane && !stage.map())
    for (const std::optional<Label>& label : peak_labels(stage))
      if (label) out.push_back(*label);
  if (stage.crowded)
    for (Label& label : out) label.box = pushed(label.box, stage.frame);
  return out;
}

void contact_bounds(const Stage& stage, Bounds& bounds) {
  for (const ContactPicture& contact : stage.picture.contacts)
    for (const ContactNode& node : contact.nodes) {
      if (stage.pressures() && contact.values.empty() && node.pressure > 0 && stage.greatest_pressure > 0) bounds.add(pressure_tip(stage, node));
      if (stage.plane && !stage.map() && stage.greatest_shear > 0 && length(node.shear) > 0)
        for (const Point& end : shear_arrow(stage, node)) bounds.add(end);
    }
  if (stage.crowded) return;
  for (const Label& label : labels(stage)) bounds.add(label.box);
}

void draw_contacts(Stage& stage, vtkRenderer* renderer) {
  std::vector<NodeMarker> markers;
  for (const ContactPicture& contact : stage.picture.contacts) {
    if (stage.map()) {
      draw_contact_map(stage, contact);
    } else if (stage.plane) {
      if (stage.strips()) draw_strip(stage, contact);
      if (contact.nodes_per_facet == 2) draw_joint(stage, contact), std::ranges::copy(draw_line(stage, contact), std::back_inserter(markers));
      if (stage.pressures() && !stage.strips()) draw_arrows(stage, contact);
      draw_shear(stage, line_shear(stage, contact));
    } else {
      add_contact_surface(stage, contact, renderer);
    }
  }
  // Where two contacts meet at a node, what bears is seen.
  std::ranges::stable_partition(markers, [](const NodeMarker& m) { return m.node->status == Status::open; });
  for (const auto& [node, size] : markers) {
    const Point at = stage.at(*node);
    stage.over.marker(status_marker(node->status), at, size * stage.em, status_colour(node->status));
    stage.tell(status_name(node->status), std::array{at});
  }
  draw_labels(stage.over, labels(stage));
}

}  // namespace

void draw_labels(Canvas& canvas, const std::vector<Label>& labels) {
  std::vector<Box> taken;
  for (const Label& label : labels) {
    if (std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return label.box.overlaps(other); })) continue;
    taken.push_back(label.box);
    if (label.tip) {
      const Point nearest{std::clamp(label.tip->x, label.box.left, label.box.right), std::clamp(label.tip->y, label.box.bottom, label.box.top)};
      if (length(*label.tip - nearest) > 1.5 * label.size) canvas.line(nearest, *label.tip, std::max(0.8, label.size / 24), label.colour);
    }
    if (label.ground > 0) canvas.box(label.box.grown(label.ground), {255, 255, 255}, 0.8);
    canvas.text(label.box.centre(), label.text,
                {.size = label.size, .across = Align::middle, .up = Align::middle, .colour = label.colour, .halo = label.ground == 0});
  }
}

Layer contact_layer() { return {5, draw_contacts, contact_legend, contact_bounds}; }

}  // namespace dotyk::figure

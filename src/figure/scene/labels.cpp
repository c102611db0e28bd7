// The greatest pressure in words, where it covers nothing; texts at points of a scene, and boxes that frame parts of it.
#include <cmath>
#include <iterator>
#include <map>

#include "base/error.hpp"
#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {
namespace {

using Line = std::array<Point, 2>;

// Outlines of bodies, surfaces of obstacles and the ends of their hatching,
// ordinates of pressure, in squares of the picture.
class Barriers {
public:
  explicit Barriers(const Stage& stage) : side_(stage.em) {
    const ScenePicture& p = stage.picture;
    for (const BodyPicture& body : p.bodies)
      for (const auto& [a, b] : pairs(body.facets)) {
        add(stage.at(body, a, p.deformation), stage.at(body, b, p.deformation));
        add(stage.at(body, a, 0), stage.at(body, b, 0));
      }
    for (const RigidPicture& rigid : p.obstacles) {
      const Point depth = hatch_depth * stage.em * stage.view.direction(rigid.into_solid);
      const std::vector<Point> at = obstacle_line(stage.view, rigid);
      for (std::size_t i = 0; i + 1 < at.size(); ++i) add(at[i], at[i + 1]), add(at[i] + depth, at[i + 1] + depth);
    }
    for (const SupportSymbol& s : p.supports) {
      const Point at = stage.at(s), out = at + stage.em * stage.view.direction(s.normal), aside = 0.6 * Point{at.y - out.y, out.x - at.x};
      add(at, out), add(out - aside, out + aside);
    }
    for (const ContactPicture& contact : p.contacts)
      if (contact.nodes_per_facet == 2) add_tips(stage, contact);
  }

  bool cross(const Box& box) const {
    const auto crosses = [&](Line line) { return crop(line[0], line[1], box); };
    return std::ranges::any_of(long_, crosses) || any_square(box, [&](const Square& at) {
             const auto found = squares_.find(at);
             return found != squares_.end() && std::ranges::any_of(found->second, crosses);
           });
  }

private:
  using Square = std::array<long, 2>;
  static constexpr double most = 64;  // squares that a line is put in

  long square(double coordinate) const { return std::lround(std::floor(coordinate / side_)); }

  template <class Ask>
  bool any_square(const Box& box, const Ask& ask) const {
    for (long i = square(box.left); i <= square(box.right); ++i)
      for (long j = square(box.bottom); j <= square(box.top); ++j)
        if (ask({i, j})) return true;
    return false;
  }

  void add(Point p, Point q) {
    Bounds box;
    box.add(p), box.add(q);
    if (!((box.width() / side_ + 1) * (box.height() / side_ + 1) <= most)) return long_.push_back({p, q});
    any_square(box, [&](const Square& at) { return squares_[at].push_back({p, q}), false; });
  }

  void add_tips(const Stage& stage, const ContactPicture& contact) {
    for (const auto& [i, j] : pairs(contact.facets)) {
      const ContactNode &a = contact.nodes[i], &b = contact.nodes[j];
      if (!(a.pressure > 0) && !(b.pressure > 0)) continue;
      const Point s = pressure_tip(stage, a), t = pressure_tip(stage, b);
      add(s, t), add(stage.at(a), s), add(stage.at(b), t);
    }
  }

  double side_;
  std::map<Square, std::vector<Line>> squares_;
  std::vector<Line> long_;
};

// The free place nearest to the wanted one: farther out along n first, then to
// the sides of it.
Box free_place(const Stage& stage, const Barriers& barriers, const Box& wanted, Point n, bool within_frame) {
  const double em = stage.em;
  // A window's sides cut the contact; a label there moves along it.
  const bool upright = std::abs(n.y) >= std::abs(n.x);
  Box lateral = stage.frame.grown(-0.3 * em);
  if (!within_frame && upright) lateral.bottom = -1e9, lateral.top = 1e9;
  if (!within_frame && !upright) lateral.left = -1e9, lateral.right = 1e9;
  const auto settled = [&](const Box& box) { return stage.window ? pushed(box, lateral) : box; };
  const double step_out = 0.4 * em, step_along = 0.25 * (upright ? wanted.width() : wanted.height());
  std::vector<std::pair<double, Box>> tries;  // with what they cost
  for (int out = 0; out <= 12; ++out)
    for (const int side : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
      const double a = out * step_out, b = side * step_along;
      tries.emplace_back(a + 0.6 * std::abs(b), settled(wanted.moved(a * n + b * Point{-n.y, n.x})));
    }
  std::stable_sort(tries.begin(), tries.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (const auto& [cost, box] : tries)
    if (!barriers.cross(box.grown(0.12 * em))) return box;
  return settled(wanted);
}

std::string words(const Stage& stage, const ContactPicture& contact, double pressure, bool singular) {
  const double greatest = std::ranges::max_element(contact.nodes, {}, &ContactNode::pressure)->pressure;
  const std::string& unit = stage.picture.pressure_unit;
  // A window may not show the greatest: then the number is that of the tallest ordinate in it.
  return (pressure < 0.9999 * greatest ? "" : "max ") + number(pressure) + (unit.empty() ? "" : " " + unit) + (singular ? singular_edge : "");
}

std::optional<Label> peak_label(const Stage& stage, const Barriers& barriers, const ContactPicture& contact, bool within_frame) {
  double greatest = 0;
  std::vector<const ContactNode*> seen, peaks;
  for (const ContactNode& node : contact.nodes)
    if (stage.shows(stage.at(node))) greatest = std::max(greatest, node.pressure), seen.push_back(&node);
  if (!(greatest > 0) || greatest < 0.02 * stage.greatest_pressure) return std::nullopt;
  // Of equal peaks that in the middle.
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(peaks), [&](const ContactNode* node) { return node->pressure >= 0.9999 * greatest; });
  const ContactNode& peak = *peaks[peaks.size() / 2];
  const std::string text = words(stage, contact, greatest, peak.sharp);
  const double em = stage.em, letters = 0.85 * em;
  const Point n = stage.view.direction(peak.normal), size = text_extent(text, letters);
  const Point off{n.x * (size.x / 2 + 0.35 * em), n.y * (size.y / 2 + 0.3 * em)};
  const Box wanted = Box::about(pressure_tip(stage, peak) + off, size);
  return Label{text, letters, stage.plane ? free_place(stage, barriers, wanted, n, within_frame) : wanted, pressure_line, 0, n, pressure_tip(stage, peak)};
}

// The place of a note's words around its point that is in the room and clear of other notes, and the end of the line to it; the nearest one.
std::optional<std::pair<Box, Point>> place_of(const Stage& stage, Point at, Point extent, const std::vector<Box>& taken) {
  const Box& room = stage.room;
  for (double far = 0.9 * stage.em; far < room.width() + room.height(); far += stage.em)
    for (const Point d : {Point{0.8, 0.6}, Point{-0.8, 0.6}, Point{0.8, -0.6}, Point{-0.8, -0.6}, Point{0, 1}, Point{0, -1}}) {
      const Point end = at + far * d;
      const Box box = Box::about({end.x + (d.x > 0 ? 0.5 : d.x < 0 ? -0.5 : 0) * extent.x, end.y + (d.y > 0 ? 0.5 : -0.5) * extent.y}, extent).grown(0.1 * stage.em);
      if (room.holds({box.left, box.bottom}) && room.holds({box.right, box.top}) && std::ranges::none_of(taken, [&](const Box& other) { return box.overlaps(other); }))
        return std::pair{box, end};
    }
  return std::nullopt;
}

void draw_note(Stage& stage, const Note& note, std::vector<Box>& taken) {
  const double em = stage.em;
  const Point at = stage.view.flat(note.position);
  const FittedText words = fitted(note.text, 0.9 * em, 0.6 * stage.room.width());
  const auto place = place_of(stage, at, extent_of(words), taken);
  if (!place) throw InputError("no room for the note \"" + note.text + "\" on the picture; make it larger");
  const auto& [box, end] = *place;
  taken.push_back(box);
  stage.over.line(at, end, std::max(1.0, em / 20), axes_ink);
  stage.over.disc(at, 0.2 * em, {255, 255, 255});
  stage.over.disc(at, 0.14 * em, axes_ink);
  stage.over.text({box.centre().x, box.top - 0.1 * em}, words, {.across = Align::middle, .up = Align::high, .colour = axes_ink, .halo = true});
}

void draw_notes(Stage& stage, vtkRenderer*) {
  for (const auto& [x0, y0, x1, y1] : stage.picture.marked) {
    const Point a = stage.view.flat({x0, y0, 0}), b = stage.view.flat({x1, y1, 0});
    const Box rim = stage.frame.grown(0.2 * stage.em);
    stage.over.outline({std::max(a.x, rim.left), std::max(a.y, rim.bottom), std::min(b.x, rim.right), std::min(b.y, rim.top)}, std::max(1.5, stage.em / 12), axes_ink);
  }
  std::vector<Box> taken;
  for (const Note& note : stage.picture.notes)
    if (stage.shows(stage.view.flat(note.position))) draw_note(stage, note, taken);
}

}  // namespace

Point pressure_tip(const Stage& stage, const ContactNode& node) {
  const Point at = stage.at(node);
  return at + stage.per_pressure() * std::max(0.0, node.pressure) * stage.view.direction(node.normal);
}

std::vector<std::optional<Label>> peak_labels(const Stage& stage, bool within_frame) {
  constexpr std::size_t most = 24;  // of contacts: more labels than that are not read
  const std::vector<ContactPicture>& contacts = stage.picture.contacts;
  const auto greatest = [](const ContactPicture* c) { return c->nodes.empty() ? 0 : std::ranges::max(c->nodes, {}, &ContactNode::pressure).pressure; };
  std::vector<const ContactPicture*> told;
  for (const ContactPicture& contact : contacts) told.push_back(&contact);
  std::ranges::stable_sort(told, std::ranges::greater{}, greatest);
  told.resize(std::min(told.size(), most));
  const Barriers barriers(stage);
  std::vector<std::optional<Label>> labels(contacts.size());
  for (const ContactPicture* contact : told) labels[static_cast<std::size_t>(contact - contacts.data())] = peak_label(stage, barriers, *contact, within_frame);
  return labels;
}

Layer note_layer() { return {7, draw_notes}; }

}  // namespace dotyk::figure

// Where everything of a scene figure goes: the scene is fitted, with equal
// axes, into what title, legend, axes and colour bar leave.
#include <algorithm>
#include <cmath>

#include "figure/scene/scene_fit.hpp"
#include "figure/scene/stage.hpp"
#include "figure/canvas/ticks.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour axis_ink{30, 30, 30};
constexpr double legend_size = 0.88;  // in em

// The axes stand off the scene, but bound a window.
double axis_gap(const Stage& stage) { return stage.window ? 0 : 0.45 * stage.em; }

struct FrameTicks {
  Ticks x, y;
};

// What the axes measure: the frame, or the bodies in it.
Box measured(const Stage& stage) {
  if (!stage.added.axes_of_bodies) return stage.frame;
  Bounds bounds;
  for (const auto& [least, most] : stage.body_boxes) bounds.add(stage.view.flat(least)), bounds.add(stage.view.flat(most));
  return bounds.empty() ? stage.frame : Box{bounds.left, bounds.bottom, bounds.right, bounds.top};
}

FrameTicks frame_ticks(const Stage& stage) {
  const Box f = measured(stage);
  const double s = stage.view.scale, em = stage.em;
  const Window w = stage.window.value_or(Window{(f.left - stage.view.origin.x) / s, (f.bottom - stage.view.origin.y) / s,
                                                (f.right - stage.view.origin.x) / s, (f.top - stage.view.origin.y) / s});
  const int nx = std::clamp(static_cast<int>(f.width() / (4.5 * em)), 2, 8), ny = std::clamp(static_cast<int>(f.height() / (3 * em)), 2, 8);
  return {linear_ticks(w[0], w[2], nx), linear_ticks(w[1], w[3], ny)};
}

void draw_axes(Stage& stage) {
  const double em = stage.em, width = std::max(1.0, em / 20), tick = 0.28 * em;
  const Box f{stage.frame.left - axis_gap(stage), stage.frame.bottom - axis_gap(stage), stage.frame.right, stage.frame.top};
  const FrameTicks ticks = frame_ticks(stage);
  const Box along = stage.added.axes_of_bodies ? measured(stage) : f;
  Canvas& c = stage.over;
  if (!stage.window) {
    c.line({along.left, f.bottom}, {along.right, f.bottom}, width, axis_ink);
    c.line({f.left, along.bottom}, {f.left, along.top}, width, axis_ink);
  }
  TextStyle style;
  style.size = legend_size * em;
  style.colour = axis_ink;
  for (const Tick& t : ticks.x.ticks) {
    const double x = std::clamp(stage.view.origin.x + stage.view.scale * t.value, f.left, f.right);
    c.line({x, f.bottom}, {x, f.bottom - (t.label.empty() ? 0.5 : 1) * tick}, width, axis_ink);
    style.across = Align::middle, style.up = Align::high;
    c.text({x, f.bottom - tick - 0.15 * em}, t.label, style);
  }
  for (const Tick& t : ticks.y.ticks) {
    const double y = std::clamp(stage.view.origin.y + stage.view.scale * t.value, f.bottom, f.top);
    c.line({f.left, y}, {f.left - (t.label.empty() ? 0.5 : 1) * tick, y}, width, axis_ink);
    style.across = Align::high, style.up = Align::middle;
    c.text({f.left - tick - 0.2 * em, y}, t.label, style);
  }
  const auto with_factor = [](const char* name, int exponent) { return exponent ? std::string(name) + " × " + power_of_ten(exponent) : std::string(name); };
  // The names stand at the far ends of the axes.
  style.across = Align::low, style.up = Align::middle;
  c.text({along.right + 0.3 * em, f.bottom}, with_factor("x", ticks.x.exponent), style);
  style.across = Align::middle, style.up = Align::low;
  c.text({f.left, along.top + (stage.window ? 0.45 : stage.added.axes_of_bodies ? 0.5 : 0.15) * em}, with_factor("y", ticks.y.exponent), style);
}

void draw_triad(Stage& stage, Point at) {
  const double length = 2 * stage.em;
  // Farthest from the eye first.
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return stage.view.towards[static_cast<std::size_t>(a)] < stage.view.towards[static_cast<std::size_t>(b)]; });
  for (const int k : order) {
    const auto i = static_cast<std::size_t>(k);
    const Point head{at.x + length * stage.view.right[i], at.y + length * stage.view.up[i]};
    if (std::hypot(head.x - at.x, head.y - at.y) < 0.2 * length) continue;
    stage.over.arrow(at, head, std::max(1.5, stage.em / 12), 0.5 * stage.em, axis_ink);
    TextStyle style;
    style.size = legend_size * stage.em;
    style.across = style.up = Align::middle;
    const double d = std::hypot(head.x - at.x, head.y - at.y);
    stage.over.text({head.x + 0.55 * stage.em * (head.x - at.x) / d, head.y + 0.55 * stage.em * (head.y - at.y) / d}, std::string(1, "xyz"[i]), style);
  }
}

bool obstacle_shows(const Stage& stage) {
  if (!stage.window) return !stage.picture.obstacles.empty();
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    const std::size_t n = rigid.points.size() / 3;
    for (std::size_t i = 0; i + (rigid.closed ? 0 : 1) < n; ++i) {
      const std::size_t j = (i + 1) % n;
      if (stage.shows(stage.view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], 0}), stage.view.flat({rigid.points[3 * j], rigid.points[3 * j + 1], 0}))) return true;
    }
  }
  return false;
}

// Whether the undeformed outline is seen beside the deformed one; in a window
// the contact drawn on that is broad.
bool displacement_shows(const Stage& stage) {
  const double least = (stage.window ? 0.3 * stage.em : 1.5) / stage.view.scale, f = stage.picture.deformation;
  for (const BodyPicture& body : stage.picture.bodies) {
    if (body.displacement.empty()) continue;
    if (!stage.window) {
      for (const double u : body.displacement)
        if (std::abs(u * f) > least) return true;
      continue;
    }
    const Facets facets = boundary(body);
    for (std::size_t e = 0; e + 1 < facets.nodes.size(); e += 2) {
      const auto a = static_cast<std::size_t>(facets.nodes[e]), b = static_cast<std::size_t>(facets.nodes[e + 1]);
      const double u = std::max(std::abs(body.displacement[3 * a]), std::abs(body.displacement[3 * a + 1]));
      if (u * std::abs(f) > least && stage.shows(stage.view.flat(node(body, a, 0)), stage.view.flat(node(body, b, 0)))) return true;
    }
  }
  return false;
}

std::vector<LegendEntry> legend_entries(const Stage& stage) {
  const double em = stage.em;
  std::vector<LegendEntry> out = contact_legend(stage);
  if (obstacle_shows(stage))
    out.push_back({"rigid obstacle", [em](Canvas& c, const Box& b) {
                     const double middle = (b.bottom + b.top) / 2;
                     c.box({b.left, middle - 0.3 * em, b.right, middle + 0.3 * em}, {205, 205, 205});
                     c.line({b.left, middle + 0.3 * em}, {b.right, middle + 0.3 * em}, std::max(1.5, em / 12), {95, 95, 95});
                   }});
  for (LegendEntry& entry : support_legend(stage)) out.push_back(std::move(entry));
  if (stage.added.legend)
    for (LegendEntry& entry : stage.added.legend(stage)) out.push_back(std::move(entry));
  if (stage.picture.undeformed_outline && stage.deformation_shows)
    out.push_back({"undeformed", [em, plane = stage.plane](Canvas& c, const Box& b) {
                     const std::array<double, 2> dash{0.35 * em, 0.22 * em};
                     const double middle = (b.bottom + b.top) / 2;
                     c.polyline(std::array<Point, 2>{{{b.left, middle}, {b.right, middle}}}, std::max(1.0, em / 18), {130, 130, 130},
                                plane ? std::span<const double>(dash) : std::span<const double>());
                   }});
  bool displaced = false;
  for (const BodyPicture& body : stage.picture.bodies) displaced = displaced || !body.displacement.empty();
  if (displaced && stage.picture.deformation != 1) out.push_back({"deformation × " + number(stage.picture.deformation), {}});
  return out;
}

}  // namespace

void draw_rim(Stage& stage) {
  const Box& f = stage.frame;
  const std::array<Point, 4> corners{{{f.left, f.bottom}, {f.right, f.bottom}, {f.right, f.top}, {f.left, f.top}}};
  stage.over.polyline(corners, std::max(1.0, stage.em / 20), axis_ink, {}, true);
}

namespace {

// What stands around the scene.
struct Surroundings {
  double bar = 0, inset = 0, column = 0;  // widths; the wider of the two
  double caption = 0;                     // height
  Legend legend;
  Box room;  // for the scene
};

// The room that all else leaves, with the widths of labels as the scene stands now.
Box room_left(const Stage& stage, const Surroundings& around, bool placed) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em;
  Box room;
  room.top = p.height - 0.7 * em - (p.title.empty() ? 0 : 1.7 * em);
  room.bottom = 0.4 * em + around.caption + around.legend.height();
  room.left = 0.8 * em;
  room.right = p.width - 0.8 * em - (around.column > 0 ? around.column + 1.0 * em : 0);
  if (!p.axes || !stage.plane) return room;
  double widest = em;
  if (placed)
    for (const Tick& t : frame_ticks(stage).y.ticks) widest = std::max(widest, text_extent(t.label, legend_size * em).x);
  room.left += widest + 0.5 * em + axis_gap(stage);
  room.bottom += 1.5 * em + axis_gap(stage);
  room.top -= (stage.window ? 1.4 : 1.1) * em;
  room.right -= 1.0 * em;
  return room;
}

// Places the scene: what stands around it depends on the place, and the place on that.
Surroundings place_scene(Stage& stage) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em;
  const Bounds scaled = scaled_bounds(stage);
  Surroundings around{0, inset_width(stage), 0, p.caption.empty() ? 0 : 1.5 * em, Legend({}, em), {}};
  stage.frame = {0, 0, static_cast<double>(p.width), static_cast<double>(p.height)};
  for (int round = 0; round < 3; ++round) {
    stage.deformation_shows = round > 0 && displacement_shows(stage);
    around.bar = colour_bar_width(stage.scale, p, em);
    around.column = std::max(around.bar, around.inset);
    around.legend = Legend(legend_entries(stage), legend_size * em, p.width - 2 * em);
    around.room = room_left(stage, around, round > 0);
    stage.window ? fit_window(stage, around.room) : fit(stage, scaled, around.room);
  }
  return around;
}

void draw_titles(Stage& stage) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em, w = p.width;
  TextStyle style;
  style.across = Align::middle;
  style.up = Align::high;
  style.size = fitting_size(p.title, 1.1 * em, w - em, true);
  style.bold = true;
  stage.over.text({w / 2, p.height - 0.6 * em}, p.title, style);
  style.up = Align::low;
  style.size = fitting_size(p.caption, legend_size * em, w - em);
  style.bold = false;
  stage.over.text({w / 2, 0.5 * em}, p.caption, style);
}

// The bar as high as the scene, within reason, and not too far from it.
void draw_column(Stage& stage, const Surroundings& around) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em, bar = around.bar, inset = around.inset;
  const Box& room = around.room;
  const double right = p.width - 0.6 * em - 0.3 * (room.width() - stage.frame.width());
  if (inset > 0) {
    const double split = bar > 0 ? room.bottom + std::min(inset + 2.4 * em, 0.52 * room.height()) : room.top - 0.15 * room.height();
    draw_colour_bar(stage.over, stage.scale, p, em, right - around.column + 0.9 * em, split + 0.6 * em, room.top);
    draw_inset(stage, {right - around.column, std::max(room.bottom, split - inset - 2.4 * em), right - around.column + inset, split});
    return;
  }
  const double height = std::clamp(stage.frame.height(), std::min(12 * em, room.height()), room.height());
  const double middle = (stage.frame.bottom + stage.frame.top) / 2;
  draw_colour_bar(stage.over, stage.scale, p, em, right - bar, middle - height / 2, middle + height / 2);
}

}  // namespace

void lay_out(Stage& stage) {
  const double em = stage.em;
  if (!stage.plane) aim(stage);
  const Surroundings around = place_scene(stage);
  const Box& room = around.room;
  draw_titles(stage);
  around.legend.draw(stage.over, {(stage.picture.width - around.legend.width()) / 2, 0.3 * em + around.caption}, false);
  draw_column(stage, around);
  if (stage.picture.axes) {
    if (stage.plane)
      draw_axes(stage);
    else
      draw_triad(stage, {room.left + 2.2 * em, room.bottom + 1.6 * em});
  }
  if (!stage.plane) stage.frame = {room.left, room.bottom, room.right, room.top};
}

}  // namespace dotyk::figure

// Where everything of a scene figure goes: the scene is fitted, with equal
// axes, into what title, legend, axes and colour bar leave.
#include <algorithm>
#include <cmath>

#include "figure/scene/scene_fit.hpp"
#include "figure/scene/stage.hpp"
#include "figure/canvas/text_fit.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour axis_ink{30, 30, 30};
constexpr double legend_size = 0.88;  // in em

// The axes stand off the scene, but bound a window.
double axis_gap(const Stage& stage) { return stage.window ? 0 : 0.45 * stage.em; }

// What the axes measure: the frame, or the bodies in it.
Box measured(const Stage& stage) {
  if (!stage.axes_of_bodies) return stage.frame;
  Bounds bounds;
  for (const auto& [least, most] : stage.body_boxes) bounds.add(stage.view.flat(least)), bounds.add(stage.view.flat(most));
  return bounds.empty() ? stage.frame : bounds;
}

// Across and up.
std::array<Ticks, 2> frame_ticks(const Stage& stage) {
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
  const auto [x_ticks, y_ticks] = frame_ticks(stage);
  const Box along = stage.axes_of_bodies ? measured(stage) : f;
  Canvas& c = stage.over;
  if (!stage.window) {
    c.line({along.left, f.bottom}, {along.right, f.bottom}, width, axis_ink);
    c.line({f.left, along.bottom}, {f.left, along.top}, width, axis_ink);
  }
  const double size = legend_size * em;
  for (const Tick& t : x_ticks.ticks) {
    const double x = std::clamp(stage.view.origin.x + stage.view.scale * t.value, f.left, f.right);
    c.line({x, f.bottom}, {x, f.bottom - (t.label.empty() ? 0.5 : 1) * tick}, width, axis_ink);
    c.text({x, f.bottom - tick - 0.15 * em}, t.label, {.size = size, .across = Align::middle, .up = Align::high, .colour = axis_ink});
  }
  for (const Tick& t : y_ticks.ticks) {
    const double y = std::clamp(stage.view.origin.y + stage.view.scale * t.value, f.bottom, f.top);
    c.line({f.left, y}, {f.left - (t.label.empty() ? 0.5 : 1) * tick, y}, width, axis_ink);
    c.text({f.left - tick - 0.2 * em, y}, t.label, {.size = size, .across = Align::high, .up = Align::middle, .colour = axis_ink});
  }
  const auto with_factor = [](const char* name, int exponent) { return exponent ? std::string(name) + " × " + power_of_ten(exponent) : std::string(name); };
  // The names stand at the far ends of the axes.
  c.text({along.right + 0.3 * em, f.bottom}, with_factor("x", x_ticks.exponent), {.size = size, .up = Align::middle, .colour = axis_ink});
  const double above = (stage.window ? 0.45 : stage.axes_of_bodies ? 0.5 : 0.15) * em;
  c.text({f.left, along.top + above}, with_factor("y", y_ticks.exponent), {.size = size, .across = Align::middle, .colour = axis_ink});
}

void draw_triad(Stage& stage, Point at) {
  const double em = stage.em, reach = 2 * em;
  // Farthest from the eye first.
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return stage.view.towards[a] < stage.view.towards[b]; });
  for (const int i : order) {
    const Point head = at + reach * Point{stage.view.right[i], stage.view.up[i]};
    const double d = length(head - at);
    if (d < 0.2 * reach) continue;
    stage.over.arrow(at, head, std::max(1.5, em / 12), 0.5 * em, axis_ink);
    stage.over.text({head.x + 0.55 * em * (head.x - at.x) / d, head.y + 0.55 * em * (head.y - at.y) / d}, std::string(1, "xyz"[i]),
                    {.size = legend_size * em, .across = Align::middle, .up = Align::middle});
  }
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
    for (const auto& [a, b] : pairs(outline_edges(body))) {
      const double u = std::max(std::abs(body.displacement[3 * a]), std::abs(body.displacement[3 * a + 1]));
      if (u * std::abs(f) > least && stage.shows(stage.at(body, a, 0), stage.at(body, b, 0))) return true;
    }
  }
  return false;
}

std::vector<LegendEntry> legend_entries(const Stage& stage) {
  std::vector<LegendEntry> out;
  for (const Layer& layer : stage.layers)
    if (layer.legend) layer.legend(stage, out);
  return out;
}

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
  const double widest = placed ? std::max(em, widest_label(frame_ticks(stage)[1], legend_size * em)) : em;
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
  stage.frame = {0, 0, 1.0 * p.width, 1.0 * p.height};
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
  TextStyle title = title_style();
  title.size = fitting_size(p.title, 1.1 * em, w - em, true);
  stage.over.text({w / 2, p.height - 0.6 * em}, p.title, title);
  stage.over.text({w / 2, 0.5 * em}, p.caption, {.size = fitting_size(p.caption, legend_size * em, w - em), .across = Align::middle});
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
  const double middle = stage.frame.centre().y;
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
  if (!stage.plane) stage.frame = room;
}

}  // namespace dotyk::figure

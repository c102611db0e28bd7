// In the plane: axes with numbers around the scene. In space: a triad that shows the directions of x, y and z.
#include "figure/scene/scene_axes.hpp"

#include <limits>

namespace dotyk::figure {

namespace {

constexpr Colour axis_ink{30, 30, 30};
constexpr double triad_reach = 2;  // em

// What the axes measure: the frame, or the bodies in it.
Box measured(const Stage& stage) {
  if (!stage.axes_of_bodies) return stage.frame;
  Bounds bounds;
  for (const auto& [least, most] : stage.body_boxes) bounds.add(stage.view.flat(least)), bounds.add(stage.view.flat(most));
  return bounds.empty() ? stage.frame : bounds;
}

// How many facets of the scene come near a box.
int facets_near(const Stage& stage, const Box& box) {
  int count = 0;
  const auto look = [&](const Facets& facets, const auto& place) {
    each_polygon(facets, [&](std::span<const int> nodes) {
      Bounds bounds;
      for (const int i : nodes) bounds.add(stage.view.flat(place(i)));
      count += bounds.overlaps(box);
    });
  };
  for (const BodyPicture& body : stage.picture.bodies)
    for (const double factor : {stage.picture.deformation, 0.0}) look({body.facets, body.nodes_per_facet}, [&](int i) { return body.node(i, factor); });
  for (const RigidPicture& o : stage.picture.obstacles) look({o.triangles, 3}, [&](int i) { return Vec3{o.points[3 * i], o.points[3 * i + 1], o.points[3 * i + 2]}; });
  return count;
}

// In the corner of the room that the scene leaves freest.
Point triad_place(const Stage& stage, const Box& room) {
  const double em = stage.em;
  Bounds triad;
  triad.add(Point{0, 0});
  for (std::size_t i = 0; i < 3; ++i) triad.add(triad_reach * em * Point{stage.view.right[i], stage.view.up[i]});
  const Box own = triad.grown(1.1 * em);  // its letters
  const Box corners{room.left - own.left, room.bottom - own.bottom, room.right - own.right, room.top - own.top};
  Point best;
  int least = std::numeric_limits<int>::max();
  for (const Point at : {Point{corners.left, corners.bottom}, {corners.right, corners.bottom}, {corners.left, corners.top}, {corners.right, corners.top}})
    if (const int near = facets_near(stage, own.moved(at)); near < least) least = near, best = at;
  return best;
}

}  // namespace

double axis_gap(const Stage& stage) { return stage.window ? 0 : 0.45 * stage.em; }

std::array<Ticks, 2> frame_ticks(const Stage& stage) {
  const Box f = measured(stage);
  const double s = stage.view.scale, em = stage.em;
  const Point o = stage.view.origin;
  const Box w = stage.window.value_or(Box{(f.left - o.x) / s, (f.bottom - o.y) / s, (f.right - o.x) / s, (f.top - o.y) / s});
  return {spaced_ticks({false, w.left, w.right, f.left, f.right}, legend_size * em), few_ticks(w.bottom, w.top, std::clamp(4.0, f.height() / (2.6 * em), f.height() / (2 * em)))};
}

std::string axis_text(const Stage& stage, std::size_t axis, int exponent) {
  const std::string& unit = stage.picture.length_unit;
  const std::string factor = exponent ? (unit.empty() ? "× " : "") + power_of_ten(exponent) : "";
  const std::string in = factor + (factor.empty() || unit.empty() ? "" : " ") + unit;
  return stage.picture.axis_names[axis] + (in.empty() ? "" : unit.empty() ? " " + in : " [" + in + "]");
}

bool is_long(const std::string& name, double em) { return text_extent(name, legend_size * em).x > 1.5 * em; }

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
  // The names stand at the far ends of the axes, a long one below the numbers.
  const std::string x_name = axis_text(stage, 0, x_ticks.exponent), y_name = axis_text(stage, 1, y_ticks.exponent);
  if (is_long(x_name, em)) c.text({along.right, f.bottom - tick - 1.2 * em}, x_name, {.size = size, .across = Align::high, .up = Align::high, .colour = axis_ink});
  else c.text({along.right + 0.3 * em, f.bottom}, x_name, {.size = size, .up = Align::middle, .colour = axis_ink});
  const double above = (stage.window ? 0.45 : stage.axes_of_bodies ? 0.5 : is_long(y_name, em) ? 0.6 : 0.15) * em;
  c.text({f.left - (is_long(y_name, em) ? 1.5 * em : 0), along.top + above}, y_name, {.size = size, .across = is_long(y_name, em) ? Align::low : Align::middle, .colour = axis_ink});
}

void draw_triad(Stage& stage, const Box& room) {
  const Point at = triad_place(stage, room);
  const double em = stage.em, reach = triad_reach * em;
  // Farthest from the eye first.
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return stage.view.towards[a] < stage.view.towards[b]; });
  for (const int i : order) {
    const Point head = at + reach * Point{stage.view.right[i], stage.view.up[i]};
    const double d = length(head - at);
    if (d < 0.2 * reach) continue;
    stage.over.arrow(at, head, std::max(1.5, em / 12), 0.5 * em, axis_ink, std::max(1.0, em / 20));
    stage.over.text({head.x + 0.55 * em * (head.x - at.x) / d, head.y + 0.55 * em * (head.y - at.y) / d}, std::string(1, "xyz"[i]),
                    {.size = legend_size * em, .across = Align::middle, .up = Align::middle, .halo = true});
  }
}

}  // namespace dotyk::figure

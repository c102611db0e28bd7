// Where everything of a scene figure goes: the scene is fitted, with equal
// axes, into what title, legend, axes and colour bar leave.
#include <algorithm>
#include <cmath>

#include "scene_fit.hpp"
#include "stage.hpp"
#include "ticks.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour ink{30, 30, 30};
constexpr double axis_gap = 0.45, legend_size = 0.88;  // in em

struct FrameTicks {
  Ticks x, y;
};

FrameTicks frame_ticks(const Stage& stage) {
  const Box& f = stage.frame;
  const double s = stage.view.scale, em = stage.em;
  const int nx = std::clamp(static_cast<int>(f.width() / (4.5 * em)), 2, 8), ny = std::clamp(static_cast<int>(f.height() / (3 * em)), 2, 8);
  return {linear_ticks((f.left - stage.view.origin.x) / s, (f.right - stage.view.origin.x) / s, nx),
          linear_ticks((f.bottom - stage.view.origin.y) / s, (f.top - stage.view.origin.y) / s, ny)};
}

void draw_axes(Stage& stage) {
  const double em = stage.em, width = std::max(1.0, em / 20), tick = 0.28 * em;
  const Box f{stage.frame.left - axis_gap * em, stage.frame.bottom - axis_gap * em, stage.frame.right, stage.frame.top};
  const FrameTicks ticks = frame_ticks(stage);
  Canvas& c = stage.over;
  c.line({f.left, f.bottom}, {f.right, f.bottom}, width, ink);
  c.line({f.left, f.bottom}, {f.left, f.top}, width, ink);
  TextStyle style;
  style.size = legend_size * em;
  style.colour = ink;
  for (const Tick& t : ticks.x.ticks) {
    const double x = stage.view.origin.x + stage.view.scale * t.value;
    c.line({x, f.bottom}, {x, f.bottom - (t.label.empty() ? 0.5 : 1) * tick}, width, ink);
    style.across = Align::middle, style.up = Align::high;
    c.text({x, f.bottom - tick - 0.15 * em}, t.label, style);
  }
  for (const Tick& t : ticks.y.ticks) {
    const double y = stage.view.origin.y + stage.view.scale * t.value;
    c.line({f.left, y}, {f.left - (t.label.empty() ? 0.5 : 1) * tick, y}, width, ink);
    style.across = Align::high, style.up = Align::middle;
    c.text({f.left - tick - 0.2 * em, y}, t.label, style);
  }
  const auto with_factor = [](const char* name, int exponent) { return exponent ? std::string(name) + " × " + power_of_ten(exponent) : std::string(name); };
  // The names stand at the far ends of the axes.
  style.across = Align::low, style.up = Align::middle;
  c.text({f.right + 0.3 * em, f.bottom}, with_factor("x", ticks.x.exponent), style);
  style.across = Align::middle, style.up = Align::low;
  c.text({f.left, f.top + 0.15 * em}, with_factor("y", ticks.y.exponent), style);
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
    stage.over.arrow(at, head, std::max(1.5, stage.em / 12), 0.5 * stage.em, ink);
    TextStyle style;
    style.size = legend_size * stage.em;
    style.across = style.up = Align::middle;
    const double d = std::hypot(head.x - at.x, head.y - at.y);
    stage.over.text({head.x + 0.55 * stage.em * (head.x - at.x) / d, head.y + 0.55 * stage.em * (head.y - at.y) / d}, std::string(1, "xyz"[i]), style);
  }
}

std::vector<LegendEntry> legend_entries(const Stage& stage) {
  const double em = stage.em;
  std::vector<LegendEntry> out = contact_legend(stage);
  if (!stage.picture.obstacles.empty())
    out.push_back({"rigid obstacle", [em](Canvas& c, const Box& b) {
                     const double middle = (b.bottom + b.top) / 2;
                     c.box({b.left, middle - 0.3 * em, b.right, middle + 0.3 * em}, {205, 205, 205});
                     c.line({b.left, middle + 0.3 * em}, {b.right, middle + 0.3 * em}, std::max(1.5, em / 12), {95, 95, 95});
                   }});
  for (LegendEntry& entry : support_legend(stage)) out.push_back(std::move(entry));
  if (stage.picture.undeformed_outline && stage.deformation_shows)
    out.push_back({"undeformed", [em, plane = stage.plane](Canvas& c, const Box& b) {
                     const std::array<double, 2> dash{0.35 * em, 0.22 * em};
                     const double middle = (b.bottom + b.top) / 2;
                     c.polyline(std::array<Point, 2>{{{b.left, middle}, {b.right, middle}}}, std::max(1.0, em / 18), {130, 130, 130},
                                plane ? std::span<const double>(dash) : std::span<const double>());
                   }});
  bool displaced = false;
  for (const BodyPicture& body : stage.picture.bodies) displaced = displaced || !body.displacement.empty();
  if (displaced) out.push_back({"deformation × " + number(stage.picture.deformation), {}});
  return out;
}

}  // namespace

void lay_out(Stage& stage) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em, w = p.width, h = p.height;
  if (!stage.plane) aim(stage);
  const Bounds scaled = scaled_bounds(stage);
  double greatest = 0;
  for (const BodyPicture& body : p.bodies)
    for (const double u : body.displacement) greatest = std::max(greatest, std::abs(u * p.deformation));

  const double caption = p.caption.empty() ? 0 : 1.5 * em;
  const double bar = colour_bar_width(stage.scale, p, em), inset = inset_width(stage);
  const double column = std::max(bar, inset);
  Legend legend({}, em);
  Box room;
  stage.frame = {0, 0, w, h};
  for (int round = 0; round < 3; ++round) {
    stage.deformation_shows = round > 0 && greatest * stage.view.scale > 1.5;
    legend = Legend(legend_entries(stage), legend_size * em, w - 2 * em);
    room.top = h - 0.7 * em - (p.title.empty() ? 0 : 1.7 * em);
    room.bottom = 0.4 * em + caption + legend.height();
    room.left = 0.8 * em;
    room.right = w - 0.8 * em - (column > 0 ? column + 1.0 * em : 0);
    if (p.axes && stage.plane) {
      double widest = em;
      if (round > 0)
        for (const Tick& t : frame_ticks(stage).y.ticks) widest = std::max(widest, text_extent(t.label, legend_size * em).x);
      room.left += widest + (axis_gap + 0.5) * em;
      room.bottom += (axis_gap + 1.5) * em;
      room.top -= 1.1 * em;
      room.right -= 1.0 * em;
    }
    fit(stage, scaled, room);
  }

  TextStyle style;
  style.across = Align::middle;
  style.up = Align::high;
  style.size = fitting_size(p.title, 1.1 * em, w - em, true);
  style.bold = true;
  stage.over.text({w / 2, h - 0.6 * em}, p.title, style);
  style.up = Align::low;
  style.size = fitting_size(p.caption, legend_size * em, w - em);
  style.bold = false;
  stage.over.text({w / 2, 0.5 * em}, p.caption, style);
  legend.draw(stage.over, {(w - legend.width()) / 2, 0.3 * em + caption}, false);

  // The bar as high as the scene, within reason, and not too far from it.
  const double spare = room.width() - stage.frame.width();
  const double right = w - 0.6 * em - 0.3 * spare;
  if (inset > 0) {
    const double split = bar > 0 ? room.bottom + std::min(inset + 2.4 * em, 0.52 * room.height()) : room.top - 0.15 * room.height();
    draw_colour_bar(stage.over, stage.scale, p, em, right - column + 0.9 * em, split + 0.6 * em, room.top);
    draw_inset(stage, {right - column, std::max(room.bottom, split - inset - 2.4 * em), right - column + inset, split});
  } else {
    const double height = std::clamp(stage.frame.height(), std::min(12 * em, room.height()), room.height());
    const double middle = (stage.frame.bottom + stage.frame.top) / 2;
    draw_colour_bar(stage.over, stage.scale, p, em, right - bar, middle - height / 2, middle + height / 2);
  }
  if (p.axes) {
    if (stage.plane)
      draw_axes(stage);
    else
      draw_triad(stage, {room.left + 2.2 * em, room.bottom + 1.6 * em});
  }
  if (!stage.plane) stage.frame = {room.left, room.bottom, room.right, room.top};
}

}  // namespace dotyk::figure

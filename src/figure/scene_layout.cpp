// Where everything of a scene figure goes: the scene is fitted, with equal
// axes, into what title, legend, axes and colour bar leave.
#include <algorithm>
#include <cmath>

#include "stage.hpp"
#include "ticks.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour ink{30, 30, 30};
constexpr double axis_gap = 0.45, legend_size = 0.88;  // in em

// Looks at the contact side from above, and from the front where it can.
void aim(Stage& stage) {
  Vec3 eye{1, -1.6, 0.95};
  if (stage.picture.view_from && dot(*stage.picture.view_from, *stage.picture.view_from) > 0) {
    eye = *stage.picture.view_from;
  } else {
    Vec3 mean{0, 0, 0};
    for (const ContactPicture& contact : stage.picture.contacts)
      for (const ContactNode& node : contact.nodes) mean = plus(mean, node.normal, node.weight > 0 ? node.weight : 1);
    mean = unit(mean);
    double best = -1e9;
    for (const Vec3& candidate : {Vec3{1, -1.6, 0.95}, Vec3{-1, -1.6, 0.95}, Vec3{1, 1.6, 0.95}, Vec3{-1, 1.6, 0.95}}) {
      const double sees = dot(unit(candidate), mean);
      if (sees > best + 0.05) best = sees, eye = candidate;
    }
  }
  View& view = stage.view;
  view.towards = unit(eye);
  const Vec3 vertical = std::abs(view.towards[2]) > 0.999 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  view.right = unit(cross(vertical, view.towards));
  view.up = cross(view.towards, view.right);
}

void add_clipped(Bounds& to, Point p, Point q, const Bounds& box) {
  if (!crop(p, q, {box.left, box.bottom, box.right, box.top})) return;
  to.add(p);
  to.add(q);
}

// All that scales with the scene, at one pixel per unit of length.
Bounds scaled_bounds(const Stage& stage) {
  View unit_view = stage.view;
  unit_view.scale = 1, unit_view.origin = {0, 0};
  Bounds bounds;
  for (const BodyPicture& body : stage.picture.bodies)
    for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
      bounds.add(unit_view.flat(node(body, i, stage.picture.deformation)));
      if (stage.picture.undeformed_outline) bounds.add(unit_view.flat(node(body, i, 0)));
    }
  if (bounds.empty()) bounds.add(Point{0, 0});
  const double size = std::max(bounds.width(), bounds.height());
  Bounds near = bounds;
  near.add(Point{bounds.left - 0.1 * size, bounds.bottom - 0.1 * size});
  near.add(Point{bounds.right + 0.1 * size, bounds.top + 0.1 * size});
  Bounds all = bounds;
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    std::vector<Point> at;
    Bounds own;
    for (std::size_t i = 0; i < rigid.points.size() / 3; ++i) {
      at.push_back(unit_view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], rigid.points[3 * i + 2]}));
      own.add(at.back());
    }
    if (own.empty()) continue;
    const bool small = std::max(own.width(), own.height()) < 1.3 * size;
    if ((rigid.closed || !stage.plane) && small) {
      all.merge(own);
    } else {
      for (std::size_t i = 0; i + 1 < at.size(); ++i) add_clipped(all, at[i], at[i + 1], near);
    }
  }
  return all;
}

// What keeps its size in pixels, at the present scale, with origin (0, 0).
void add_symbols(Bounds& bounds, const Stage& stage) {
  const ScenePicture& p = stage.picture;
  if (stage.strips() || stage.arrows())
    for (const ContactPicture& contact : p.contacts)
      for (const ContactNode& node : contact.nodes) {
        if (!(node.pressure > 0) || !(stage.greatest_pressure > 0)) continue;
        const Point at = stage.view.flat(stage.deformed(node.position, node.displacement)), n = stage.view.direction(node.normal);
        const double length = stage.strip_height() * node.pressure / stage.greatest_pressure;
        bounds.add({at.x + n.x * length, at.y + n.y * length});
      }
  if ((stage.strips() || stage.arrows()) && inset_width(stage) == 0)
    for (const ContactPicture& contact : p.contacts)
      if (const std::optional<PeakLabel> label = peak_label(stage, contact)) {
        bounds.add(Point{label->box.left, label->box.bottom});
        bounds.add(Point{label->box.right, label->box.top});
      }
  if (stage.plane)
    for (const SupportSymbol& s : p.supports) {
      const Point at = stage.view.flat(stage.deformed(s.position, s.displacement)), n = stage.view.direction(s.normal);
      const double r = 1.35 * support_size * stage.em;
      bounds.add({at.x + n.x * r, at.y + n.y * r});
    }
  const double greatest = greatest_load(p);
  for (const LoadArrow& load : p.loads)
    for (const Point& end : load_arrow(stage, load, greatest)) bounds.add(end);
  if (stage.plane)
    for (const RigidPicture& rigid : p.obstacles) {
      if (rigid.closed) continue;
      const Point d = stage.view.direction(rigid.into_solid);
      const double depth = hatch_depth * stage.em;
      Bounds inside = bounds;
      for (std::size_t i = 0; i + 1 < rigid.points.size() / 3; ++i) {
        Bounds piece;
        add_clipped(piece, stage.view.flat({rigid.points[3 * i], rigid.points[3 * i + 1], 0}),
                    stage.view.flat({rigid.points[3 * i + 3], rigid.points[3 * i + 4], 0}), bounds);
        if (piece.empty()) continue;
        if (d.y < -0.3) inside.add(Point{piece.left, piece.bottom + d.y * depth});
        if (d.y > 0.3) inside.add(Point{piece.left, piece.top + d.y * depth});
        if (d.x < -0.3) inside.add(Point{piece.left + d.x * depth, piece.bottom});
        if (d.x > 0.3) inside.add(Point{piece.right + d.x * depth, piece.bottom});
      }
      bounds = inside;
    }
}

Bounds pixel_bounds(Stage& stage, const Bounds& scaled) {
  stage.view.origin = {0, 0};
  const double s = stage.view.scale;
  Bounds bounds;
  bounds.add(Point{s * scaled.left, s * scaled.bottom});
  bounds.add(Point{s * scaled.right, s * scaled.top});
  add_symbols(bounds, stage);
  // Half a line and a marker stand beyond the body.
  const double rim = 0.3 * stage.em;
  bounds.add(Point{bounds.left - rim, bounds.bottom - rim});
  bounds.add(Point{bounds.right + rim, bounds.top + rim});
  return bounds;
}

// Finds scale and origin so that all lies in the room.
void fit(Stage& stage, const Bounds& scaled, const Box& room) {
  // A scene without extent in a direction, or in any, does not ask for room.
  const double size = std::max(scaled.width(), scaled.height());
  const double width = scaled.width() > 1e-6 * size ? scaled.width() : 0, height = scaled.height() > 1e-6 * size ? scaled.height() : 0;
  const auto share = [](double pixels, double length) { return length > 0 ? pixels / length : 1e300; };
  stage.view.scale = size > 0 ? std::min(share(room.width(), width), share(room.height(), height)) : 1;
  for (int round = 0; round < 8 && size > 0; ++round) {
    const Bounds now = pixel_bounds(stage, scaled);
    const double over_x = now.width() - room.width(), over_y = now.height() - room.height();
    const double s = stage.view.scale;
    stage.view.scale = std::max(0.2 * s, s - std::max(width > 0 ? over_x / width : -1e300, height > 0 ? over_y / height : -1e300));
    if (std::abs(stage.view.scale - s) < 1e-6 * s) break;
  }
  const Bounds now = pixel_bounds(stage, scaled);
  stage.view.origin = {(room.left + room.right) / 2 - (now.left + now.right) / 2, (room.bottom + room.top) / 2 - (now.bottom + now.top) / 2};
  const Point o = stage.view.origin;
  stage.frame = {now.left + o.x, now.bottom + o.y, now.right + o.x, now.top + o.y};
}

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

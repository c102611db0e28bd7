// Where everything of a scene figure goes: the scene is fitted, with equal
// axes, into what title, legend, axes and colour bar leave.
#include "base/error.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/scene/scene_axes.hpp"

namespace dotyk::figure {

namespace {

// Of what grows with the scale and of symbols, which do not, at the present scale with origin (0, 0).
Bounds pixel_bounds(Stage& stage, const Bounds& scaled) {
  stage.view.origin = {0, 0};
  const double s = stage.view.scale;
  Bounds bounds;
  bounds.add(Box{s * scaled.left, s * scaled.bottom, s * scaled.right, s * scaled.top});
  std::vector<Layer> downwards = stage.layers;
  std::stable_sort(downwards.begin(), downwards.end(), [](const Layer& a, const Layer& b) { return a.height > b.height; });
  for (const Layer& layer : downwards)
    if (layer.bounds) layer.bounds(stage, bounds);
  bounds.add(bounds.grown(0.3 * stage.em));  // half a line and a marker stand beyond the body
  return bounds;
}

// In space: looks at the contact side from above, and from the front where it can.
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
  if (!stage.body_boxes.empty()) view.depth = dot(part_way(stage.body_boxes[0][0], stage.body_boxes[0][1], 0.5), view.towards);  // VTK keeps coordinates in single precision
  if (!stage.picture.region) return;
  const auto& r = *stage.picture.region;
  Bounds seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{r[corner & 1 ? 3 : 0], r[corner & 2 ? 4 : 1], r[corner & 4 ? 5 : 2]};
    seen.add(Point{dot(p, view.right), dot(p, view.up)});
  }
  stage.window = stage.asked = seen;
}

// Bounds of all that grows with the scene, at one pixel per unit of length:
// bodies, small obstacles, and the near part of large ones.
Bounds scaled_bounds(const Stage& stage) {
  View unit_view = stage.view;
  unit_view.scale = 1, unit_view.origin = {0, 0};
  Bounds all;
  for (const BodyPicture& body : stage.picture.bodies)
    for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
      all.add(unit_view.flat(body.node(i, stage.picture.deformation)));
      all.add(unit_view.flat(body.node(i, 0)));
    }
  if (all.empty()) all.add(Point{0, 0});
  const double size = std::max(all.width(), all.height());
  const Box near = all.grown(0.1 * size);
  for (const RigidPicture& rigid : stage.picture.obstacles) {
    const std::vector<Point> at = obstacle_line(unit_view, rigid);
    if (at.empty()) continue;
    Bounds own;
    for (const Point& p : at) own.add(p);
    if (!stage.plane && std::max(own.width(), own.height()) < 1.3 * size) all.add(own);
    else
      for (std::size_t i = 0; i + 1 < at.size(); ++i)
        if (Point p = at[i], q = at[i + 1]; crop(p, q, near)) all.add(p), all.add(q);
  }
  return all;
}

// Finds scale and origin so that the scene with its symbols, which keep their size in pixels, fills the room; sets stage.view and
// stage.frame.
void fit(Stage& stage, const Bounds& scaled, const Box& room) {
  // A scene without extent in a direction, or in any, does not ask for room.
  const double size = std::max(scaled.width(), scaled.height());
  const double width = scaled.width() > 1e-6 * size ? scaled.width() : 0, height = scaled.height() > 1e-6 * size ? scaled.height() : 0;
  const auto share = [](double pixels, double length) { return length > 0 ? pixels / length : 1e300; };
  const double most = stage.view.scale = size > 0 ? std::min(share(room.width(), width), share(room.height(), height)) : 1;
  for (int round = 0; round < 8 && size > 0; ++round) {
    const Bounds now = pixel_bounds(stage, scaled);
    const double over_x = now.width() - room.width(), over_y = now.height() - room.height();
    const double s = stage.view.scale;
    stage.view.scale = std::max(0.2 * s, s - std::max(width > 0 ? over_x / width : -1e300, height > 0 ? over_y / height : -1e300));
    if (std::abs(stage.view.scale - s) < 1e-6 * s) break;
  }
  constexpr double kCrowded = 0.3;
  if (stage.view.scale < kCrowded * most && !std::exchange(stage.crowded, true)) return fit(stage, scaled, room);
  const Bounds now = pixel_bounds(stage, scaled);
  stage.view.origin = room.centre() - now.centre();
  stage.frame = now.moved(stage.view.origin);
  stage.drawn = {0, 0, stage.view.scale * width, stage.view.scale * height};
}

// Whether the undeformed outline is seen beside the deformed one; in a window
// the contact drawn on that is broad.
bool displacement_shows(const Stage& stage) {
  const double least = (stage.window ? 0.3 * stage.em : 1.5) / stage.view.scale, f = stage.picture.deformation;
  for (const BodyPicture& body : stage.picture.bodies) {
    if (!stage.window && greatest(body.displacement) * std::abs(f) > least) return true;
    if (!stage.window || body.displacement.empty()) continue;
    for (const auto& [a, b] : pairs(outline_edges(body))) {
      const double u = std::max(std::abs(body.displacement[3 * a]), std::abs(body.displacement[3 * a + 1]));
      if (u * std::abs(f) > least && stage.shows(stage.at(body, a, 0), stage.at(body, b, 0))) return true;
    }
  }
  return false;
}

// What stands around the scene.
struct Surroundings {
  double bar = 0, column = 0;  // widths of the colour bar, and of the widest of what stands in its column
  double caption = 0;          // height
  double labels = 0;           // width of the numbers up the axis, the widest so far
  Legend legend;
  bool beside = false;         // the legend stands in that column, not below
  Box room;                    // for the scene
};

FittedText title_of(const ScenePicture& p, double em) { return fitted(p.title, 1.1 * em, p.width - em, true); }

// The caption; a window of a map that leaves out some of what presses says so, with the greatest pressure of all.
std::string words_below(const ScenePicture& p) {
  double most = 0, beyond = 0;
  for (const ContactPicture& contact : p.contacts)
    for (const ContactNode& node : contact.nodes) {
      if (contact.nodes_per_facet == 2 || !p.window || p.bodies.front().dimension != 2) continue;
      most = std::max(most, node.pressure);
      if (!box_of(*p.window).holds({node.position[0], node.position[1]})) beyond = std::max(beyond, node.pressure);
    }
  if (!(beyond > 0)) return p.caption;
  return (p.caption.empty() ? "" : p.caption + "; ") + at_most("part shown; pressure of the contact", most, p.pressure_unit);
}

FittedText caption_of(const ScenePicture& p, double em) { return fitted(words_below(p), em, p.width - em); }

// The room that all else leaves, with the widths of labels as the scene stands now.
Box room_left(const Stage& stage, Surroundings& around, bool placed) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em;
  Box room;
  room.top = p.height - 0.7 * em - (p.title.empty() ? 0 : 1.7 * em + title_of(p, em).depth());
  room.bottom = 0.4 * em + around.caption + (around.beside ? 0 : around.legend.height());
  room.left = 0.8 * em;
  room.right = p.width - 0.8 * em - (around.column > 0 ? around.column + 1.0 * em : 0);
  if (!p.axes || !stage.plane) return room;
  around.labels = std::max({around.labels, em, placed ? widest_label(frame_ticks(stage)[1], legend_size * em) : 0});
  room.left += around.labels + 0.5 * em + axis_gap(stage);
  const bool below = placed && is_long(axis_text(stage, 0, frame_ticks(stage)[0].exponent), em);
  room.bottom += (below ? 2.6 : 1.5) * em + axis_gap(stage);
  room.top -= (stage.window || is_long(axis_text(stage, 1, 0), em) ? 1.5 : 1.1) * em;
  room.right -= (below ? 0.6 : 1.0) * em;
  return room;
}

// Places the scene: what stands around it depends on the place, and the place on that.
Surroundings place_scene(Stage& stage, const Bounds& scaled, bool beside) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em;
  Surroundings around{0, 0, words_below(p).empty() ? 0 : 1.5 * em + caption_of(p, em).depth(), 0, Legend({}, em), beside, {}};
  stage.frame = {0, 0, 1.0 * p.width, 1.0 * p.height};
  stage.crowded = false;
  for (int round = 0; round < 3; ++round) {
    stage.deformation_shows = round > 0 && displacement_shows(stage);
    stage.entries.clear();
    for (const Layer& layer : stage.layers)
      if (layer.legend) layer.legend(stage, stage.entries);
    around.legend = Legend(stage.own_legend ? stage.entries : std::vector<LegendEntry>{}, legend_size * em, beside ? 0 : p.width - 2 * em);
    around.bar = stage.own_bar ? colour_bar_width(stage.scale, field_of(p), em) : 0;
    around.column = std::max({around.bar, stage.inset ? 1.0 * stage.inset->width : 0.0, beside ? around.legend.width() : 0});
    around.room = room_left(stage, around, round > 0);
    stage.window ? fit_window(stage, around.room) : fit(stage, scaled, around.room);
  }
  return around;
}

// What stands in the column, one above the other.
double column_height(const Stage& stage, const Surroundings& around) {
  return (around.bar > 0 ? least_bar_height(stage.scale, field_of(stage.picture), stage.em, around.column) : 0) + (stage.inset ? stage.inset->height : 0) + (around.beside ? around.legend.height() : 0);
}

// The room of the column, which goes down beside the axis.
double room_of_column(const Stage& stage, const Surroundings& around) {
  return around.room.top - (around.beside ? 0.4 * stage.em + around.caption : around.room.bottom);
}

// The legend stands beside a scene that is larger by that.
Surroundings place_scene(Stage& stage) {
  constexpr double kLarger = 1.1, kWidest = 0.45;
  const Bounds scaled = scaled_bounds(stage);
  const Surroundings below = place_scene(stage, scaled, false);
  const double scale = stage.view.scale;
  if (!stage.own_legend || stage.entries.empty()) return below;
  const Surroundings beside = place_scene(stage, scaled, true);
  const bool fits = beside.column < kWidest * stage.picture.width && column_height(stage, beside) < room_of_column(stage, beside);
  if (fits && stage.view.scale > kLarger * scale) return beside;
  return place_scene(stage, scaled, false);
}

// The bar as high as the scene, within reason, and not too far from it; above the inset where there is one.
void draw_column(Stage& stage, const Surroundings& around) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em;
  const Box& room = around.room;
  const double right = p.width - 0.6 * em - 0.3 * std::max(0.0, room.width() - stage.frame.width());
  const double spare = std::max(0.0, room_of_column(stage, around) - column_height(stage, around)), left = right - around.column;
  double bottom = room.top - room_of_column(stage, around) + (around.bar > 0 ? 0 : spare / 2);
  if (around.beside) {
    around.legend.draw(stage.over, {left, bottom}, false);
    bottom += around.legend.height();
  }
  if (stage.inset) {
    draw_inset(stage, {right - stage.inset->width, bottom});
    bottom += stage.inset->height;
  }
  if (!(around.bar > 0)) return;
  const bool alone = !stage.inset && !around.beside;
  const double low = 0.4 * em + around.caption + around.legend.height(), free = room.top - low;  // beside the axis, too
  const double height = alone ? std::clamp(stage.frame.height(), std::min(13 * em, free), free) : std::min(room.top - bottom, 22 * em);
  const double middle = alone ? std::clamp(stage.frame.centre().y, low + height / 2, room.top - height / 2) : room.top - height / 2;
  draw_colour_bar(stage.over, stage.scale, field_of(p), em, {alone ? right - around.bar : left + (stage.inset ? 2 * em : 0.5 * em), middle - height / 2, p.width - 0.3 * em, middle + height / 2});
}

// In the plane, where symbols and labels leave less than a share of the room to the scene itself: how many pixels more they need across or up; else none.
std::optional<double> more_for_symbols(const Stage& stage, double (Box::*extent)() const, const Box& room) {
  constexpr double kShare = 0.3;
  const double drawn = (stage.drawn.*extent)(), symbols = (stage.frame.*extent)() - drawn, all = (room.*extent)();
  if (!stage.plane || stage.window || drawn >= kShare * all || symbols <= (1 - kShare) * all) return std::nullopt;
  return symbols / (1 - kShare) - all;
}

}  // namespace

double lay_out(Stage& stage) {
  const ScenePicture& p = stage.picture;
  const double em = stage.em, w = p.width;
  if (!stage.plane) aim(stage);
  const Surroundings around = place_scene(stage);
  stage.room = around.room;
  stage.over.text({w / 2, p.height - 0.6 * em}, title_of(p, em), title_style());
  const FittedText caption = caption_of(p, em);
  stage.over.text({w / 2, 0.5 * em + caption.depth()}, caption, {.across = Align::middle});
  if (!around.beside) around.legend.draw(stage.over, {(w - around.legend.width()) / 2, 0.3 * em + around.caption}, false);
  draw_column(stage, around);
  if (p.axes && stage.plane) draw_axes(stage);
  if (p.axes && !stage.plane) draw_triad(stage, around.room);
  double missing = std::max({column_height(stage, around) - room_of_column(stage, around), least_plot(p) - around.room.height(), stage.frame.height() - around.room.height()});
  if (!stage.plane && !stage.window) stage.frame = around.room;
  if (const auto more = more_for_symbols(stage, &Box::height, around.room)) missing = std::max(missing, *more);
  return missing;
}

double lacking_width(const Stage& stage) {
  constexpr double kLeast = 15;  // mm
  const ScenePicture& p = stage.picture;
  double lacks = std::max(kLeast / printed_width(p) * p.width - stage.room.width(), stage.frame.width() - stage.room.width() - 1);
  if (const auto more = more_for_symbols(stage, &Box::width, stage.room); more && stage.drawn.width() > 0) lacks = std::max(lacks, *more);
  for (const LegendEntry& entry : stage.entries)
    if (stage.own_legend) lacks = std::max(lacks, Legend({entry}, legend_size * stage.em).width() + 2 * stage.em - p.width);
  return lacks;
}

void refuse_narrow(const Sheet& sheet, double lacks, const std::string& remedy) {
  if (lacks <= 0) return;
  const double mm = printed_width(sheet) / sheet.width;
  throw InputError(text("a scene in ", sheet.file, " has no room beside its letters and symbols where that is ", std::floor(sheet.width * mm), " mm wide; make it ",
                        std::ceil((sheet.width + lacks) * mm + 0.5), " mm wide at least", remedy));
}

}  // namespace dotyk::figure

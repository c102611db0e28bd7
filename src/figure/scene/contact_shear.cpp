// Friction on the contact boundary, as arrows.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/scene/spread.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double longest = 1.5, least_share = 0.1;  // of an arrow: em, and of the greatest shear

double size(const Vec3& v) { return std::sqrt(dot(v, v)); }

// The nodes whose arrows are drawn: of those that rub, some that stand apart.
template <class Choice>
std::vector<std::size_t> nodes_with_arrow(const Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, Choice choice) {
  std::vector<std::size_t> rubbing;
  std::vector<Point> places;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (size(contact.nodes[i].shear) >= least_share * stage.greatest_shear) rubbing.push_back(i), places.push_back(at[i]);
  std::vector<std::size_t> out;
  for (const std::size_t k : choice(places)) out.push_back(rubbing[k]);
  return out;
}

void draw(Stage& stage, Point tail, Point head) {
  const double em = stage.em;
  stage.over.arrow(tail, head, std::max(1.4, em / 11), 0.42 * em, shear_line, std::max(0.9, em / 24));
}

}  // namespace

std::array<Point, 2> shear_arrow(const Stage& stage, const ContactNode& node) {
  const Point at = stage.view.flat(stage.place(node)), n = stage.view.direction(node.normal), t = stage.view.direction(node.shear);
  const double half = 0.5 * longest * stage.em * size(node.shear) / stage.greatest_shear, off = 0.75 * stage.em;
  const Point middle{at.x - off * n.x, at.y - off * n.y};
  return {{{middle.x - half * t.x, middle.y - half * t.y}, {middle.x + half * t.x, middle.y + half * t.y}}};
}

void draw_shear(Stage& stage, const ContactPicture& contact) {
  if (!(stage.greatest_shear > 0)) return;
  std::vector<Point> at;
  for (const ContactNode& node : contact.nodes) at.push_back(stage.view.flat(stage.place(node)));
  const auto along_edge = [&](const std::vector<Point>& places) { return stage.spaced(places, 1.1 * longest * stage.em); };
  for (const std::size_t i : nodes_with_arrow(stage, contact, at, along_edge)) {
    const auto [tail, head] = shear_arrow(stage, contact.nodes[i]);
    draw(stage, tail, head);
  }
}

void draw_shear(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, std::size_t across, std::size_t up) {
  if (!(stage.greatest_shear > 0)) return;
  const double half = 0.5 * stage.em / stage.greatest_shear;
  const auto on_plan = [&](const std::vector<Point>& places) { return spread(places, places, 0.85 * stage.em); };
  for (const std::size_t i : nodes_with_arrow(stage, contact, at, on_plan)) {
    const Vec3& shear = contact.nodes[i].shear;
    const double x = half * shear[across], y = half * shear[up];
    draw(stage, {at[i].x - x, at[i].y - y}, {at[i].x + x, at[i].y + y});
  }
}

std::vector<LegendEntry> shear_legend(const Stage& stage) {
  if (!(stage.greatest_shear > 0)) return {};
  return {{"shear", [em = stage.em](Canvas& c, const Box& b) {
             const double middle = (b.bottom + b.top) / 2;
             c.arrow({b.left + 0.1 * em, middle}, {b.right - 0.1 * em, middle}, std::max(1.4, em / 11), 0.42 * em, shear_line);
           }}};
}

}  // namespace dotyk::figure

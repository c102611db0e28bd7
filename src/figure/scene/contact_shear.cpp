// Friction on the contact boundary, as arrows.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "figure/scene/spread.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double longest = 1.5, least_share = 0.1;  // of an arrow: em, and of the greatest shear

double magnitude(const Vec3& v) { return std::sqrt(dot(v, v)); }

using Choice = std::function<std::vector<std::size_t>(const std::vector<Point>&)>;
using Arrow = std::function<std::array<Point, 2>(std::size_t node)>;

// At some of the nodes that rub, which stand apart.
void draw_chosen(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, const Choice& choice, const Arrow& arrow) {
  if (!(stage.greatest_shear > 0)) return;
  std::vector<std::size_t> rubbing;
  std::vector<Point> places;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (magnitude(contact.nodes[i].shear) >= least_share * stage.greatest_shear) rubbing.push_back(i), places.push_back(at[i]);
  const double em = stage.em;
  for (const std::size_t k : choice(places)) {
    const auto [tail, head] = arrow(rubbing[k]);
    stage.over.arrow(tail, head, std::max(1.4, em / 11), 0.42 * em, shear_line, std::max(0.9, em / 24));
  }
}

}  // namespace

std::array<Point, 2> shear_arrow(const Stage& stage, const ContactNode& node) {
  const double half = 0.5 * longest * stage.em * magnitude(node.shear) / stage.greatest_shear;
  const Point middle = stage.at(node) - 0.75 * stage.em * stage.view.direction(node.normal), t = stage.view.direction(node.shear);
  return {middle - half * t, middle + half * t};
}

void draw_shear(Stage& stage, const ContactPicture& contact) {
  draw_chosen(stage, contact, stage.at(contact.nodes), [&](const std::vector<Point>& places) { return stage.spaced(places, 1.1 * longest * stage.em); },
              [&](std::size_t i) { return shear_arrow(stage, contact.nodes[i]); });
}

void draw_shear(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, const Plan& plan) {
  const double half = 0.5 * stage.em / stage.greatest_shear;
  draw_chosen(stage, contact, at, [&](const std::vector<Point>& places) { return spread(places, places, 0.85 * stage.em); },
              [&](std::size_t i) { return std::array{at[i] - half * plan(contact.nodes[i].shear), at[i] + half * plan(contact.nodes[i].shear)}; });
}

}  // namespace dotyk::figure

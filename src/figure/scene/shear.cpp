// Arrows of the friction: beside the contact line, and on maps.
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr double longest_shear = 1.5, least_arrow = 0.3;  // em

// Moved along itself until it is between the ends of the contact line, beyond which it would act on nothing; a longer one to their middle.
Segment moved_between(const Box& line, const Segment& arrow) {
  const Point way = arrow[1] - arrow[0];
  const bool across = std::abs(way.x) >= std::abs(way.y);
  const auto [low, high] = across ? std::pair{line.left, line.right} : std::pair{line.bottom, line.top};
  const auto [begin, end] = std::minmax(across ? arrow[0].x : arrow[0].y, across ? arrow[1].x : arrow[1].y);
  if (!(end > begin)) return arrow;
  const double along = end - begin > high - low ? (low + high - begin - end) / 2 : std::max(0.0, low - begin) - std::max(0.0, end - high);
  const Point shift = along / (across ? way.x : way.y) * way;
  return {arrow[0] + shift, arrow[1] + shift};
}

}  // namespace

// The ends of the arrow of a node's shear, beside the contact line on the side of the first part, which it acts on.
Segment shear_arrow(const Stage& stage, const ContactNode& node) {
  const double half = 0.5 * shear_scale(stage, longest_shear) * length(node.shear);
  const Point middle = stage.at(node) - 0.75 * stage.em * stage.view.direction(node.normal), t = stage.view.direction(node.shear);
  return {middle - half * t, middle + half * t};
}

double shear_scale(const Stage& stage, double longest) {
  constexpr double kBeside = 0.1;  // of the greatest pressure: less is not drawn as long as what is alone
  if (stage.plane && !stage.map() && stage.pressures()) return stage.per_pressure();
  return longest * stage.em / std::max(stage.greatest_shear, kBeside * stage.greatest_pressure);
}

std::vector<Segment> shear_arrows(const Stage& stage, const ContactPicture& contact, const std::vector<Point>& at, double spacing,
                                  const std::function<Segment(std::size_t node)>& arrow) {
  if (!(stage.greatest_shear > 0)) return {};
  std::vector<Segment> out;
  std::vector<std::size_t> rubbing;  // whose arrow is not too short to be seen, and in the picture as a whole
  for (std::size_t i = 0; i < contact.nodes.size(); ++i)
    if (const Segment s = arrow(i); contact.nodes[i].status != Status::open && length(s[1] - s[0]) >= least_arrow * stage.em && stage.shows(s[0]) && stage.shows(s[1])) rubbing.push_back(i);
  for (const std::size_t i : spread(at, rubbing, [&](std::size_t k) { return length(contact.nodes[k].shear); }, spacing)) out.push_back(arrow(i));
  return out;
}

void draw_shear(Stage& stage, const std::vector<Segment>& arrows) {
  for (const Segment& arrow : arrows) {
    stage.over.arrow(arrow[0], arrow[1], std::max(1.4, stage.em / 11), shear_head * stage.em, shear_line, std::max(0.9, stage.em / 24));
    stage.tell("shear", arrow);
  }
}

std::vector<Segment> line_shear(const Stage& stage, const ContactPicture& contact) {
  const double spacing = std::max(0.95 * stage.em, 1.1 * shear_scale(stage, longest_shear) * stage.greatest_shear);
  const std::vector<Point> at = stage.at(contact.nodes);
  Bounds line;
  for (const Point& p : at) line.add(p);
  return shear_arrows(stage, contact, at, spacing, [&](std::size_t i) { return moved_between(line, shear_arrow(stage, contact.nodes[i])); });
}

}  // namespace dotyk::figure

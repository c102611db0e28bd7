#include "figure/chart/chart_categories.hpp"

namespace dotyk::figure {

namespace {

constexpr double between = 0.5;  // em, from a name to the next

bool whole(const FittedText& text, const std::string& name) {
  std::string all;
  for (const std::string& line : text.lines) all += (all.empty() ? "" : " ") + line;
  return all == name;
}

}  // namespace

CategoryNames::CategoryNames(const std::vector<std::string>& names, double em, double spacing, double height) {
  constexpr double kMostUpright = 0.35;  // of the picture's height
  const double room = spacing - between * em;
  double size = em;
  for (const std::string& name : names) {
    names_.push_back(fitted(name, em, room));
    size = std::min(size, names_.back().size);
    upright_ = upright_ || !whole(names_.back(), name) || text_extent(names_.back().lines[0], names_.back().size).x > room + 1;
  }
  if (upright_) {
    size = least_letters * em;
    for (std::size_t k = 0; k < names.size(); ++k) names_[k] = {size, {shortened(names[k], size, kMostUpright * height)}};
  }
  for (FittedText& text : names_) {
    text.size = size;
    height_ = std::max(height_, upright_ ? text_extent(text.lines[0], size).x : size + text.depth());
  }
}

void CategoryNames::draw(Canvas& canvas, const Axes& axes) const {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const Point foot{axes.x.pixel(static_cast<double>(k) + 1), axes.room.bottom - 0.35 * axes.em};
    canvas.text(foot, names_[k], {.across = Align::middle, .up = Align::high, .upright = upright_});
  }
}

}  // namespace dotyk::figure

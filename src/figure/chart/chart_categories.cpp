#include "figure/chart/chart_categories.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::figure {

namespace {

constexpr double between = 0.5;  // em, from a name to the next

bool whole(const FittedText& text, const std::string& name) {
  std::string all;
  for (const std::string& line : text.lines) all += (all.empty() ? "" : " ") + line;
  return all == name;
}

}  // namespace

CategoryNames::CategoryNames(const std::vector<std::string>& names, double em, double spacing) {
  const double room = spacing - between * em;
  double size = em;
  for (const std::string& name : names) {
    names_.push_back(fitted(name, em, room));
    size = std::min(size, names_.back().size);
    upright_ = upright_ || !whole(names_.back(), name) || text_extent(names_.back().lines[0], names_.back().size).x > room + 1;
  }
  if (upright_) {
    constexpr double kLine = 1.25, kLong = 8;  // of the letters; em
    size = least_letters * em;
    const double lines = std::clamp(std::floor(spacing / (kLine * size)), 1.0, 3.0);
    for (std::size_t k = 0; k < names.size(); ++k) {
      const double length = text_extent(names[k], size).x;
      const FittedText broken = fitted(names[k], em, std::max(kLong * em, 1.2 * length / lines));
      names_[k] = lines > 1 && length > kLong * em && whole(broken, names[k]) ? broken : FittedText{size, {names[k]}};
    }
    crowded_ = spacing < size;
  }
  for (FittedText& text : names_) {
    text.size = size;
    if (!upright_) height_ = std::max(height_, size + text.depth());
    for (const std::string& line : text.lines)
      if (upright_) height_ = std::max(height_, text_extent(line, size).x);
  }
}

void CategoryNames::draw(Canvas& canvas, const Axes& axes) const {
  if (crowded_) throw InputError(text("the names of ", names_.size(), " categories meet even upright: give fewer, or a greater 'width'"));
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const Point foot{axes.x.pixel(static_cast<double>(k) + 1) - (upright_ ? names_[k].depth() / 2 : 0), axes.room.bottom - 0.35 * axes.em};
    canvas.text(foot, names_[k], {.across = Align::middle, .up = Align::high, .upright = upright_});
  }
}

}  // namespace dotyk::figure

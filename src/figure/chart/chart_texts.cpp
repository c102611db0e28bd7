#include "figure/chart/chart_texts.hpp"

#include "base/error.hpp"
#include "figure/chart/chart_look.hpp"

namespace dotyk::figure {
namespace {

constexpr double between_names = 0.5;  // em, from a name to the next

bool whole(const FittedText& text, const std::string& name) {
  std::string all;
  for (const std::string& line : text.lines) all += (all.empty() ? "" : " ") + line;
  return all == name;
}

// Half-extents of a block to either side of its point.
constexpr std::array aside{0.0, 1.0, -1.0, 0.5, -0.5};

// The block of this size beside a point, so many pixels from it.
Box beside(Point p, double across, double up, Point size, double gap) {
  const double away = size.x / 2 + (std::abs(across) == 1 ? gap : 0);
  return Box::about(p + Point{across * away, up * (size.y / 2 + gap)}, size);
}

// The box moved into the room, level or upright.
Box within(const Box& box, const Box& room, double margin, bool level) {
  const auto shift = [margin](double low, double high, double least, double most) {
    return low < least + margin ? least + margin - low : std::min(0.0, most - margin - high);
  };
  return box.moved(level ? Point{shift(box.left, box.right, room.left, room.right), 0} : Point{0, shift(box.bottom, box.top, room.bottom, room.top)});
}

bool free(const Box& box, const Occupied& occupied, const Box& room, double gap) {
  return room.holds({box.left, box.bottom}, -gap) && room.holds({box.right, box.top}, -gap) && occupied.distance(box) >= gap;
}

// Points along the part of a curve in the room, from its end on.
std::vector<Point> spread(const std::vector<Point>& curve, const Box& room, double spacing) {
  std::vector<Point> out;
  for (std::size_t i = curve.size(); i-- > 1;) {
    Point p = curve[i], q = curve[i - 1];
    if (!crop(p, q, room)) continue;
    const int n = 1 + static_cast<int>(length(q - p) / spacing);
    for (int k = 0; k <= n; ++k) out.push_back(part_way(p, q, static_cast<double>(k) / n));
  }
  return out;
}

Occupied around(const ChartPicture& picture, const ChartAxes& axes, const SeriesPicture& but) {
  Occupied out;
  for (const SeriesPicture& s : picture.series)
    for (const auto& curve : curves(s.x, s.y, axes.of(s)))
      if (&s != &but) out.add(curve, axes.left.room);
  return out;
}

// Where a text of this size stands beside a curve, as far from others as can be.
std::optional<Box> place_along(const std::vector<std::vector<Point>>& lines, const Occupied& all, const Occupied& others, const Axes& axes, Point size) {
  const double gap = 0.3 * axes.em, far = 3 * axes.em;
  std::optional<Box> found;
  double most = -1;
  for (const auto& line : lines)
    for (const Point& p : spread(line, axes.room, 0.4 * axes.em))
      for (const double across : aside)
        for (const double up : {1.0, -1.0, 0.0}) {
          if (up == 0 && std::abs(across) < 1) continue;
          const Box box = beside(p, across, up, size, gap);
          if (!free(box, all, axes.room, 0.8 * gap)) continue;
          const double away = std::min(far, others.distance(box));
          if (away > most) most = away, found = box;
        }
  return found;
}

// Beside its curve, upright where level texts have no place.
std::optional<PlotText> name_beside(const ChartPicture& picture, const ChartAxes& axes, const SeriesPicture& s, const Occupied& occupied) {
  const Occupied others = around(picture, axes, s);
  const Axes& own = axes.of(s);
  const double size = small_text * own.em;
  const Point level = text_extent(s.name, size);
  const auto lines = curves(s.x, s.y, own);
  for (const bool upright : {false, true})
    if (const auto box = place_along(lines, occupied, others, own, upright ? Point{level.y, level.x} : level)) return PlotText{{size, {s.name}}, *box, picture.map ? axes_ink : reference_grey, upright};
  return std::nullopt;
}

// In one line, and broken at the space nearest to its middle.
std::vector<FittedText> ways_to_write(const std::string& text, double size) {
  std::vector<FittedText> out{{size, {text}}};
  const std::size_t before = text.rfind(' ', text.size() / 2), after = text.find(' ', text.size() / 2);
  const std::size_t space = before == std::string::npos || (after != std::string::npos && after + before < text.size()) ? after : before;
  if (space != std::string::npos && space > 0) out.push_back({size, {text.substr(0, space), text.substr(space + 1)}});
  return out;
}

// As near to its point as can be, but not upon a marker there; none where there is no free place.
std::optional<PlotText> note_near(const ChartNote& note, const ChartAxes& axes, const Occupied& occupied) {
  constexpr double kNearest = 0.7, kFarthest = 10, kMargin = 0.25;  // em
  const double em = axes.left.em, from = 0.35 * em;
  const Point at = axes.left.at(note.x, note.y);
  const std::vector<FittedText> ways = ways_to_write(note.text, small_text * em);
  const auto written = [&](const FittedText& text, const Box& box) {
    const Point end{std::clamp(at.x, box.left, box.right), std::clamp(at.y, box.bottom, box.top)}, way = end - at;
    return PlotText{text, box, axes_ink, false, std::array{at + from / std::max(from, length(way)) * way, end}};
  };
  for (double gap = kNearest * em; gap < kFarthest * em; gap += 0.3 * em)
    for (const FittedText& text : ways)
      for (const double across : aside)
        for (const double up : {1.0, -1.0, 0.0}) {
          const Box box = within(beside(at, across, up, extent_of(text), gap), axes.left.room, kMargin * em, up != 0);
          if ((up != 0 || std::abs(across) == 1) && free(box, occupied, axes.left.room, kMargin * em)) return written(text, box);
        }
  for (const FittedText& text : ways)
    if (const auto middle = place_beside(occupied, axes.left.room, at, extent_of(text), kMargin * em)) return written(text, Box::about(*middle, extent_of(text)));
  return std::nullopt;
}

void check_inside(const ChartNote& note, const Axes& axes) {
  const auto within = [](const Axis& axis, double v) { return v >= axis.low && v <= axis.high; };
  if ((axes.pole || within(axes.x, note.x)) && within(axes.y, note.y)) return;
  throw InputError(text("the note \"", note.text, "\" is at (", note.x, ", ", note.y, "), but the axes go from (", axes.x.low, ", ", axes.y.low, ") to (", axes.x.high, ", ", axes.y.high, ")"));
}

}  // namespace

CategoryNames::CategoryNames(const std::vector<std::string>& names, double em, double spacing) {
  const double room = spacing - between_names * em;
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

std::vector<PlotText> plot_texts(const ChartPicture& picture, const ChartAxes& axes, Occupied& occupied, SeriesSet& crowded, const ChartNote*& crowded_note) {
  std::vector<PlotText> out;
  const auto add = [&](PlotText text) {
    occupied.add(text.box);
    if (text.leader) occupied.add({(*text.leader)[0], (*text.leader)[1]}, axes.left.room);
    out.push_back(std::move(text));
  };
  crowded_note = nullptr;
  for (const ChartNote& note : picture.notes) {
    check_inside(note, axes.left);
    auto text = crowded_note ? std::nullopt : note_near(note, axes, occupied);
    if (text) add(std::move(*text));
    else if (!crowded_note) crowded_note = &note;
  }
  if (!names_beside(picture)) return out;
  for (const SeriesPicture& s : picture.series) {
    if (!s.reference || s.name.empty() || crowded.contains(&s)) continue;
    if (auto text = name_beside(picture, axes, s, occupied)) add(std::move(*text));
    else crowded.insert(&s);
  }
  return out;
}

void draw(Canvas& canvas, const PlotText& text, double em) {
  if (text.leader) canvas.line((*text.leader)[0], (*text.leader)[1], std::max(1.0, em / 20), text.colour);
  const Point first = text.box.centre() + Point{0, text.words.depth() / 2};
  canvas.text(first, text.words, {.across = Align::middle, .up = Align::middle, .upright = text.upright, .colour = text.colour, .halo = true});
}

}  // namespace dotyk::figure

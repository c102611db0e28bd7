#include "figure/chart/chart_texts.hpp"

#include "figure/chart/chart_look.hpp"

namespace dotyk::figure {

namespace {

struct Candidate {
  Box box;
  double cost = INFINITY;
};

// Where texts may stand around points of a curve: at their corners and sides, within the room.
class BesideCurve {
public:
  BesideCurve(const Occupied& all, const Occupied& others, const Box& room, double em) : all_(all), others_(others), room_(room), em_(em) {}

  // The free place of least cost: near the curve, far from other curves.
  Candidate best(const std::vector<Point>& curve, Point size) const {
    Candidate found;
    const double gap = 0.3 * em_;
    for (const Point& p : spread(curve))
      for (const double across : {0.0, 1.0, -1.0})
        for (const double up : {1.0, -1.0, 0.0}) {
          const Box box = Box::about(p + Point{across * (size.x / 2 + gap), up * (size.y / 2 + gap)}, size);
          if ((across == 0 && up == 0) || !room_.holds({box.left, box.bottom}, -gap) || !room_.holds({box.right, box.top}, -gap)) continue;
          if (all_.distance(box) < 0.8 * gap) continue;
          const double cost = 3 * em_ - std::min(3 * em_, others_.distance(box));
          if (cost < found.cost) found = {box, cost};
        }
    return found;
  }

private:
  // Points along the curve, from its end on.
  std::vector<Point> spread(const std::vector<Point>& curve) const {
    std::vector<Point> out;
    for (std::size_t i = curve.size(); i-- > 1;) {
      Point p = curve[i], q = curve[i - 1];
      if (!crop(p, q, room_)) continue;
      const int n = 1 + static_cast<int>(length(q - p) / (0.4 * em_));
      for (int k = 0; k <= n; ++k) out.push_back(part_way(p, q, static_cast<double>(k) / n));
    }
    return out;
  }

  const Occupied &all_, &others_;
  const Box& room_;
  double em_;
};

Occupied around(const ChartPicture& picture, const ChartAxes& axes, const SeriesPicture& but) {
  Occupied out;
  for (const SeriesPicture& s : picture.series)
    for (const auto& curve : curves(s.x, s.y, axes.of(s)))
      if (&s != &but) out.add(curve, axes.left.room);
  return out;
}

// Beside its curve, upright where level texts have no place.
std::optional<PlotText> name_beside(const ChartPicture& picture, const ChartAxes& axes, const SeriesPicture& s, const Occupied& occupied) {
  const double em = axes.left.em;
  const Occupied others = around(picture, axes, s);
  const BesideCurve places(occupied, others, axes.left.room, em);
  const Point level = text_extent(s.name, small_text * em), size[] = {level, {level.y, level.x}};
  Candidate best;
  bool upright = false;
  const auto take = [&](const Candidate& found, bool turned) {
    if (found.cost < best.cost) best = found, upright = turned;
  };
  const auto lines = curves(s.x, s.y, axes.of(s));
  for (const auto& line : lines) take(places.best(line, size[0]), false);
  if (best.cost == INFINITY)
    for (const auto& line : lines) take(places.best(line, size[1]), true);
  if (best.cost == INFINITY) return std::nullopt;
  return PlotText{s.name, best.box, reference_grey, upright};
}

PlotText note_near(const ChartNote& note, const ChartAxes& axes, const Occupied& occupied) {
  const double em = axes.left.em;
  const Box& room = axes.left.room;
  const Point at = axes.left.at(note.x, note.y), size = text_extent(note.text, small_text * em);
  // Not upon the marker that is meant.
  Occupied all = occupied;
  all.add(Box::about(at, {1.4 * em, 1.4 * em}));
  std::optional<Point> place;
  for (const double margin : {0.5 * em, 0.25 * em, 0.1 * em})
    if (!place) place = place_beside(all, room, at, size, margin);
  const Box box = Box::about(place.value_or(at + Point{0, 1.5 * em}), size);
  const Point end{std::clamp(at.x, box.left, box.right), std::clamp(at.y, box.bottom, box.top)}, way = end - at;
  const double away = 0.35 * em;
  if (!(length(way) > 2 * away)) return {note.text, box, axes_ink};
  return {note.text, box, axes_ink, false, std::array{at + away / length(way) * way, end - 0.1 * em / length(way) * way}};
}

}  // namespace

std::vector<PlotText> plot_texts(const ChartPicture& picture, const ChartAxes& axes, Occupied& occupied, SeriesSet& crowded) {
  std::vector<PlotText> out;
  const auto add = [&](PlotText text) {
    occupied.add(text.box);
    if (text.leader) occupied.add({(*text.leader)[0], (*text.leader)[1]}, axes.left.room);
    out.push_back(std::move(text));
  };
  for (const ChartNote& note : picture.notes) add(note_near(note, axes, occupied));
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
  canvas.box(text.box, {255, 255, 255}, 0.85);
  canvas.text(text.box.centre(), text.text, {.size = small_text * em, .across = Align::middle, .up = Align::middle, .upright = text.upright, .colour = text.colour});
}

}  // namespace dotyk::figure

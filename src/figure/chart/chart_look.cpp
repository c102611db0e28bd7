#include "figure/chart/chart_look.hpp"

#include "figure/chart/chart_map.hpp"

namespace dotyk::figure {

namespace {

constexpr double legend_letters = 0.92;  // em
constexpr Colour front_yellow{255, 232, 150};
constexpr std::array markers{Marker::disc, Marker::square, Marker::triangle, Marker::diamond,
                             Marker::down_triangle, Marker::ring, Marker::cross, Marker::plus};

// Methods have the same colour and marker in every chart: their places in this order, dashed beyond as many as there are colours.
constexpr std::array methods{"pdas", "newton", "projected_cg", "interior_point", "uzawa", "active_set", "psor", "feti", "multigrid", "uzawa_pdas", "coulomb_loop", "penalty", "proximal"};

bool takes_colour(const SeriesPicture& s) { return !s.reference && !s.twin && !s.front && !s.status; }

// For each series that takes a colour, the place of its name among the methods. Empty if one has another name, or two have the same.
std::vector<int> places_of_methods(const std::vector<SeriesPicture>& series) {
  std::vector<int> places;
  for (const SeriesPicture& s : series) {
    if (!takes_colour(s)) continue;
    const int place = static_cast<int>(std::find(methods.begin(), methods.end(), s.name) - methods.begin());
    if (place == static_cast<int>(methods.size()) || std::find(places.begin(), places.end(), place) != places.end()) return {};
    places.push_back(place);
  }
  return places;
}

// Those of a legend.
std::vector<Look> named(const ChartPicture& picture, const std::set<const SeriesPicture*>& also = {}) {
  const bool beside = names_beside(picture);
  std::vector<Look> out;
  for (const Look& look : looks(picture))
    if (!look.data.name.empty() && !(beside && look.data.reference && !also.contains(&look.data))) out.push_back(look);
  return out;
}

std::string name_of(const Look& look, const ChartPicture& picture) {
  const bool told = !look.data.right || look.colour == right_colour(picture);
  return look.data.name + (told ? "" : " →");
}

}  // namespace

// Reference curves, statuses and twins take no colour of their own, so the k-th series keeps its own. Beside statuses, and on the
// cells of a map, only colours that are none of theirs.
std::vector<Look> looks(const ChartPicture& picture) {
  constexpr int kColours = 7;
  constexpr std::array clear{0, 2, 6}, clear_of_cells{6, 3, 2};
  const std::vector<SeriesPicture>& series = picture.series;
  const bool statuses = std::any_of(series.begin(), series.end(), [](const SeriesPicture& s) { return s.status.has_value(); });
  const std::vector<int> places = statuses ? std::vector<int>{} : places_of_methods(series);
  std::vector<Look> out;
  int own = 0;
  for (const SeriesPicture& s : series) {
    if (takes_colour(s)) ++own;
    int k = std::max(0, own - 1);
    if (!places.empty()) k = places[k];
    const Colour colour = s.front ? front_yellow : s.reference ? reference_grey : s.status ? status_colour(*s.status) : series_colour(statuses ? clear[k % clear.size()] : picture.map ? clear_of_cells[k % clear.size()] : k);
    out.push_back({s, colour, s.status ? status_marker(*s.status) : markers[k % markers.size()], s.reference || s.twin || (!statuses && k >= kColours)});
  }
  return out;
}

bool names_beside(const ChartPicture& picture) {
  return std::ranges::count_if(picture.series, [](const SeriesPicture& s) { return s.reference && !s.name.empty(); }) > 1;
}

Colour right_colour(const ChartPicture& picture) {
  std::vector<Colour> own;
  for (const Look& look : looks(picture))
    if (look.data.right && !look.data.reference) own.push_back(look.colour);
  return own.size() == 1 ? own.front() : axes_ink;
}

void Pen::sample(Canvas& canvas, const Look& look, const Box& b) const {
  const SeriesPicture& s = look.data;
  if (s.front) return canvas.polyline(b.midline(), front_width(), look.colour);
  const Point middle = b.centre();
  if (!s.low.empty() && !s.bars) canvas.box({b.left, middle.y - 0.3 * em, b.right, middle.y + 0.3 * em}, look.colour, 0.2);
  if (!s.low.empty() && s.bars) whisker(canvas, {middle - Point{0, 0.5 * em}, middle + Point{0, 0.5 * em}}, look);
  if (s.style != SeriesStyle::points || s.reference) stroke(canvas, b.midline(), look);
  if (s.style != SeriesStyle::line && !s.reference) mark(canvas, look, middle);
}

void Pen::stroke(Canvas& canvas, std::span<const Point> points, const Look& look, double rim) const {
  const std::array<double, 2> dash{0.42 * em, 0.26 * em};
  canvas.polyline(points, line_width() + 2 * rim, look.colour, look.dashed ? std::span<const double>(dash) : std::span<const double>());
}

void Pen::mark(Canvas& canvas, const Look& look, Point at, double rim) const {
  const double size = marker_size(look.data) + 2 * rim;
  if (look.data.crossed) canvas.crossed_marker(look.marker, at, size, look.colour);
  else canvas.marker(look.marker, at, size, look.colour);
}

void Pen::whisker(Canvas& canvas, const std::array<Point, 2>& ends, const Look& look) const {
  const double width = 0.8 * line_width();
  const Point cap = 0.22 * em * (ends[0].x == ends[1].x ? Point{1, 0} : Point{0, 1});
  canvas.line(ends[0], ends[1], width, look.colour);
  for (const Point& end : ends) canvas.line(end - cap, end + cap, width, look.colour);
}

namespace {

bool look_alike(const Look& a, const Look& b) {
  const auto all = [](const Look& l) { return std::tuple(l.data.reference ? Marker::disc : l.marker, l.dashed, l.data.style, l.data.reference, l.data.front, l.data.crossed, l.data.bars, l.data.low.empty()); };
  return a.colour == b.colour && all(a) == all(b);
}

LegendEntry entry(const std::string& name, const Look& look, double em) {
  constexpr double kMarker = 0.8, kLine = 2;  // em
  const SeriesPicture& s = look.data;
  const bool marker = s.style == SeriesStyle::points && !s.reference && !s.front && (s.low.empty() || s.bars);
  return {name, [pen = Pen{em}, look](Canvas& canvas, const Box& box) { pen.sample(canvas, look, box); }, marker ? kMarker : kLine};
}

}  // namespace

bool legend_serves(const ChartPicture& with, const ChartPicture& other) {
  const std::vector<Look> those = named(with);
  const auto found = [&](const Look& y) {
    return std::ranges::any_of(those, [&](const Look& x) { return name_of(x, with) == name_of(y, other) && look_alike(x, y); });
  };
  const bool cells = !other.map || (with.map && with.map->names == other.map->names);
  return cells && !names_beside(with) && !names_beside(other) && std::ranges::all_of(named(other), found);
}

Legend common_legend(const std::vector<ChartPicture>& panels, double em, double width) {
  std::vector<LegendEntry> entries;
  std::vector<std::pair<std::string, Look>> seen;
  const ChartMap* cells = nullptr;
  bool shared = false;
  for (const ChartPicture& panel : panels) {
    if (names_beside(panel)) return Legend({}, em);
    for (const Look& look : named(panel)) {
      const std::string name = name_of(look, panel);
      const auto same = std::ranges::find_if(seen, [&](const auto& other) { return other.first == name || look_alike(other.second, look); });
      if (same == seen.end()) seen.emplace_back(name, look);
      else if (same->first != name || !look_alike(same->second, look)) return Legend({}, em);
      else shared = true;
    }
    if (!panel.map || map_legend(*panel.map).empty()) continue;
    if (cells && cells->names != panel.map->names) return Legend({}, em);
    shared = shared || cells;
    if (!cells || map_legend(*panel.map).size() > map_legend(*cells).size()) cells = &*panel.map;
  }
  if (cells) entries = map_legend(*cells);
  for (const auto& [name, look] : seen) entries.push_back(entry(name, look, em));
  return Legend(shared ? std::move(entries) : std::vector<LegendEntry>(), legend_letters * em, width);
}

Legend chart_legend(const ChartPicture& picture, double em, double width, const std::set<const SeriesPicture*>& also) {
  std::vector<LegendEntry> entries = picture.map ? map_legend(*picture.map) : std::vector<LegendEntry>();
  for (const Look& look : named(picture, also)) entries.push_back(entry(name_of(look, picture), look, em));
  return Legend(std::move(entries), legend_letters * em, width);
}

}  // namespace dotyk::figure

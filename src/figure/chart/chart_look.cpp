#include "figure/chart/chart_look.hpp"

#include <numeric>

#include "figure/chart/chart.hpp"

namespace dotyk::figure {

namespace {

constexpr double legend_letters = 0.92;  // em
constexpr int series_colours = 7;
constexpr Colour front_yellow{255, 232, 150};
constexpr std::array markers{Marker::disc, Marker::square, Marker::triangle, Marker::diamond,
                             Marker::down_triangle, Marker::ring, Marker::cross, Marker::plus};

// Methods have the same colour and marker in every chart: their places in this order, dashed beyond as many as there are colours.
constexpr std::array methods{"pdas", "newton", "projected_cg", "interior_point", "uzawa", "active_set", "psor", "feti", "multigrid", "uzawa_pdas", "coulomb_loop", "penalty", "proximal"};

bool takes_colour(const SeriesPicture& s) { return !s.reference && !s.twin && !s.front && !s.status; }

// "projected CG" as projected_cg.
std::string identifier(std::string name) {
  std::ranges::transform(name, name.begin(), [](char c) { return c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return name;
}

// The place of each name. A method, however its name is written, has its place among the methods; the other names take, in their order, the first
// places whose colour none of these methods has.
std::vector<int> places_of(const std::vector<std::string>& names) {
  std::vector<int> places;
  std::vector<bool> taken(methods.size() + names.size() + series_colours, false);
  for (const std::string& name : names) {
    const auto place = static_cast<std::size_t>(std::ranges::find(methods, identifier(name)) - methods.begin());
    places.push_back(place < methods.size() ? static_cast<int>(place) : -1);
    if (place < methods.size()) taken[place] = taken[place % series_colours] = true;
  }
  std::size_t next = 0;
  for (int& place : places) {
    if (place >= 0) continue;
    while (taken[next]) ++next;
    place = static_cast<int>(next++);
  }
  return places;
}

// The series before the i-th that has the same name and differs in the y axis, or in whether its runs failed: both have one colour. Or none.
std::optional<std::size_t> same_before(const std::vector<SeriesPicture>& series, std::size_t i) {
  const SeriesPicture& s = series[i];
  for (std::size_t k = 0; k < i; ++k) {
    const SeriesPicture& other = series[k];
    if (takes_colour(other) && takes_colour(s) && !s.name.empty() && other.name == s.name && (other.right != s.right || other.crossed != s.crossed)) return k;
  }
  return std::nullopt;
}

std::vector<std::string> names_with_colours(const std::vector<SeriesPicture>& series) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < series.size(); ++i)
    if (takes_colour(series[i]) && !same_before(series, i)) out.push_back(series[i].name);
  return out;
}

bool all_different(std::vector<std::string> names) {
  std::ranges::transform(names, names.begin(), identifier);
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) == names.end();
}

bool has_statuses(const ChartPicture& picture) {
  return std::ranges::any_of(picture.series, [](const SeriesPicture& s) { return s.status.has_value(); });
}

// The place of each series in the list of colours and markers, counted from 0. Reference curves, statuses and twins do not count.
std::vector<int> places(const ChartPicture& picture) {
  const std::vector<std::string> names = names_with_colours(picture.series);
  std::vector<int> own(names.size()), out;
  std::iota(own.begin(), own.end(), 0);
  if (all_different(names) && !has_statuses(picture)) own = places_of(names);
  std::size_t next = 0;
  for (std::size_t i = 0; i < picture.series.size(); ++i) {
    const SeriesPicture& s = picture.series[i];
    const auto same = same_before(picture.series, i);
    const bool takes = takes_colour(s) && !same;
    out.push_back(takes ? own[next] : same ? out[*same] : out.empty() ? 0 : out.back());
    if (s.place) out.back() = *s.place;
    if (takes) ++next;
  }
  return out;
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

bool look_alike(const Look& a, const Look& b) {
  const auto all = [](const Look& l) { return std::tuple(l.data.reference ? Marker::disc : l.marker, l.dashed, l.data.style, l.data.reference, l.data.front, l.data.crossed, l.data.bars, l.data.low.empty()); };
  return a.colour == b.colour && all(a) == all(b);
}

LegendEntry entry(const std::string& name, const Look& look, double em) {
  constexpr double kMarker = 0.8, kLine = 2;  // em
  const SeriesPicture& s = look.data;
  const bool marker = !has_line(s) && !s.front && (s.low.empty() || s.bars);
  return {name, [pen = Pen{em}, look](Canvas& canvas, const Box& box) { pen.sample(canvas, look, box); }, marker ? kMarker : kLine};
}

}  // namespace

// Beside statuses, and on the cells of a map, only colours that are none of theirs.
std::vector<Look> looks(const ChartPicture& picture) {
  constexpr std::array clear{0, 2, 6}, clear_of_cells{6, 3, 2};
  const std::vector<SeriesPicture>& series = picture.series;
  const bool statuses = has_statuses(picture);
  const std::vector<int> at = places(picture);
  const auto beside = [&](std::size_t i) {
    const auto same = same_before(series, i);
    return same && series[*same].right != series[i].right;
  };
  std::vector<Look> out;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const SeriesPicture& s = series[i];
    const int k = at[i];
    const Colour colour = s.front ? front_yellow : s.reference ? reference_grey : s.status ? status_colour(*s.status) : series_colour(statuses ? clear[k % clear.size()] : picture.map ? clear_of_cells[k % clear.size()] : k);
    out.push_back({s, colour, s.status ? status_marker(*s.status) : markers[k % markers.size()], s.reference || s.twin || beside(i) || (!statuses && k >= series_colours)});
  }
  return out;
}

void share_looks(std::vector<ChartPicture>& panels) {
  std::vector<std::string> all;
  for (const ChartPicture& panel : panels) {
    const std::vector<std::string> names = names_with_colours(panel.series);
    if (!all_different(names) || has_statuses(panel) || panel.map) return;
    for (const std::string& name : names) {
      if (name.empty()) return;
      if (std::ranges::find(all, name) == all.end()) all.push_back(name);
    }
  }
  if (std::ssize(all) > series_colours) return;
  const std::vector<int> place = places_of(all);
  for (ChartPicture& panel : panels)
    for (SeriesPicture& s : panel.series)
      if (takes_colour(s)) s.place = place[static_cast<std::size_t>(std::ranges::find(all, s.name) - all.begin())];
}

bool has_line(const SeriesPicture& s) { return !s.front && !s.y.empty() && (s.style != SeriesStyle::points || s.reference); }

bool names_beside(const ChartPicture& picture) {
  return std::ranges::count_if(picture.series, [](const SeriesPicture& s) { return s.reference && !s.name.empty(); }) > 1;
}

Colour right_colour(const ChartPicture& picture) {
  std::vector<Colour> own;
  const std::vector<Look> all = looks(picture);
  for (const Look& look : all)
    if (look.data.right && !look.data.reference) own.push_back(look.colour);
  const bool tells = own.size() == 1 && std::ranges::none_of(all, [&](const Look& look) { return !look.data.right && look.colour == own.front(); });
  return tells ? own.front() : axes_ink;
}

void Pen::sample(Canvas& canvas, const Look& look, const Box& b) const {
  const SeriesPicture& s = look.data;
  if (s.front) return canvas.polyline(b.midline(), front_width(), look.colour);
  const Point middle = b.centre();
  if (!s.low.empty() && !s.bars) canvas.box({b.left, middle.y - 0.3 * em, b.right, middle.y + 0.3 * em}, look.colour, 0.2);
  if (!s.low.empty() && s.bars) whisker(canvas, {middle - Point{0, 0.5 * em}, middle + Point{0, 0.5 * em}}, look);
  if (has_line(s)) stroke(canvas, b.midline(), look);
  if (s.style != SeriesStyle::line && !s.reference) mark(canvas, look, middle);
}

void Pen::stroke(Canvas& canvas, std::span<const Point> points, const Look& look) const {
  const std::array<double, 2> dash{0.42 * em, 0.34 * em};
  canvas.polyline(points, line_width(), look.colour, look.dashed ? std::span<const double>(dash) : std::span<const double>());
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

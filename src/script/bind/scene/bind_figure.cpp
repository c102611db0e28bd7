#include <cstdio>

#include "script/bind/figure_keys.hpp"

namespace dotyk::script {
namespace {

using figure::SeriesPicture;
using figure::SeriesStyle;

std::vector<Key> series_keys() {
  using figure::Status;
  using S = SeriesPicture;
  return {
      key::string("name", "its name in the legend").into(&S::name),
      key::vector("x", "abscissas").required().into(&S::x), key::vector("y", "ordinates, nan for a gap; crossed points may have none").or_nan().into(&S::y),
      key::vector("low", "lower end of a spread, drawn as a band").into(&S::low), key::vector("high", "upper end of a spread").into(&S::high),
      key::boolean("bars", "the spread as a whisker at each point instead").into(&S::bars),
      key::vector("x_low", "left end of a whisker at each point").into(&S::x_low), key::vector("x_high", "right end of it").into(&S::x_high),
      key::choice<SeriesStyle>("style", {{"line", SeriesStyle::line}, {"points", SeriesStyle::points}, {"both", SeriesStyle::both}}, "how it is drawn").into(&S::style),
      key::boolean("reference", "a reference curve: dashed, without markers; of several the names stand beside them, not in the legend").into(&S::reference),
      key::choice<bool>("axis", {{"left", false}, {"right", true}}, "which y axis it has; on the right an arrow in the legend says so, or the colour of an axis that has no other series").into(&S::right),
      key::boolean("crossed", "markers pale and crossed out, for runs that failed; without y in a strip above "
                    "the plot, a row for each such series").into(&S::crossed),
      key::boolean("front", "a broad pale line beneath all others, for what is best").into(&S::front),
      key::boolean("twin", "dashed, with the colour and marker of the series before it").into(&S::twin),
      key::choice<Status>("status", {{"open", Status::open}, {"closed", Status::closed}, {"stick", Status::stick}, {"slip", Status::slip}},
                           "with the colour and marker that contact nodes of this status have in scenes").otherwise("none").into(&S::status)};
}

Key map_key() {
  using figure::ChartMap;
  return key::table("map", {key::vector("x", "abscissas, ascending").some().required().into(&ChartMap::x), key::vector("y", "ordinates, ascending").some().required().into(&ChartMap::y),
                            key::matrix("values", "a row for each y, nan where it does not apply").or_nan().required(),
                            key::string("label", "of the colour bar; needed without 'names'; maps with one label have one scale in all panels").into(&ChartMap::label), key::string("unit", "of the values").into(&ChartMap::unit),
                            key::list("names", key::string("", ""), "what the values 1, 2, … stand for, in place of a colour bar").count(1, figure::most_map_names).into(&ChartMap::names)},
                    "coloured cells around the points of a grid, beneath the series");
}

// Of a chart, alone or a panel.
std::vector<Key> chart_keys() {
  using figure::ChartPicture;
  using figure::ChartNote;
  const Key note = key::table("", {key::number("x", "abscissa of the point").required().into(&ChartNote::x), key::number("y", "ordinate of it").required().into(&ChartNote::y),
                                   key::string("text", "what is said of it").required().into(&ChartNote::text)}, "");
  return {title_key("above the chart").into<ChartPicture>([](ChartPicture& chart) -> std::string& { return chart.title; }),
          key::string("x", "label of the x axis").into(&ChartPicture::x_label), key::string("y", "label of the y axis").into(&ChartPicture::y_label),
          key::string("y_right", "label of a second y axis, of the series whose axis is \"right\"").into(&ChartPicture::y_right_label),
          key::choice("log", {"", "x", "y", "xy"}, "which axes are logarithmic; values of zero and below "
                      "are left out, and counted on standard error").fallback(""),
          key::list("series", key::table("", series_keys(), "one curve"), "the curves").some(),
          key::string("strip", "what it means to stand in the strip of crossed points without y").fallback("not converged").into(&ChartPicture::strip_label),
          map_key(),
          key::list("categories", key::string("", ""), "names of x = 1, 2, … in place of numbers").some().into(&ChartPicture::categories),
          key::vector("x_range", "ends of the x axis").count(2).otherwise("the data with a margin"),
          key::vector("y_range", "ends of the y axis").count(2).otherwise("the data with a margin"),
          key::vector("y_break", "{from, to}: what the y axis leaves out").count(2).otherwise("none").into(&ChartPicture::y_break),
          key::boolean("polar", "x is an angle in degrees, anticlockwise from the right, y a radius").into(&ChartPicture::polar),
          key::list("notes", note, "texts near points, which thin lines lead to").otherwise("none"),
          key::vector("slopes", "guides of these slopes, each beside the curve of nearest slope").otherwise("none")};
}

SeriesPicture series_of(const Arguments& given) {
  const SeriesPicture series = given.filled<SeriesPicture>();
  if (!given.has("y") && !series.crossed) throw InputError(text("series '", series.name, "': missing key 'y'; only points that are crossed may have none"));
  if (given.has("y") && series.x.size() != series.y.size() && !(series.crossed && series.y.empty()))
    throw InputError(text("series '", series.name, "' has ", series.x.size(), " x and ", series.y.size(), " y"));
  return series;
}

figure::ChartMap map_of(const Arguments& given) {
  figure::ChartMap map = given.filled<figure::ChartMap>();
  const std::vector<std::vector<double>> rows = given.matrix("values");
  if (rows.size() != map.y.size()) throw InputError(text("'map': ", rows.size(), " rows of values for ", map.y.size(), " y"));
  for (std::size_t j = 0; j < rows.size(); ++j) {
    if (rows[j].size() != map.x.size()) throw InputError(text("'map': row ", j + 1, " has ", rows[j].size(), " values for ", map.x.size(), " x"));
    map.values.insert(map.values.end(), rows[j].begin(), rows[j].end());
  }
  return map;
}

/// Says on standard error what the axes cannot show: "2 of 5 points of 'error'".
void tell_not_shown(const figure::ChartPicture& picture, const std::string& file) {
  const auto has_place = [&](double x, std::optional<double> y) {
    const bool in_break = y && picture.y_break && *y > (*picture.y_break)[0] && *y < (*picture.y_break)[1];
    return !(picture.log_x && x <= 0) && !(picture.log_y && y && *y <= 0) && !in_break;
  };
  std::string out;
  for (std::size_t k = 0; k < picture.series.size(); ++k) {
    const figure::SeriesPicture& series = picture.series[k];
    std::size_t lost = 0;
    for (std::size_t i = 0; i < series.x.size(); ++i) lost += !has_place(series.x[i], series.y.empty() ? std::nullopt : std::optional(series.y[i]));
    if (lost == 0) continue;
    out += text(out.empty() ? "" : ", ", lost, " of ", series.x.size(), " points of ");
    out += series.name.empty() ? text("series ", k + 1) : "'" + series.name + "'";
  }
  const bool log = picture.log_x || picture.log_y;
  const std::string why = text(log ? "zero and negative values have no place on a logarithmic axis" : "", log && picture.y_break ? ", nor have those in 'y_break'" : picture.y_break ? "values in 'y_break' have no place on its axis" : "");
  if (!out.empty()) std::fprintf(stderr, "dotyk: %s: %s; left out: %s\n", file.c_str(), why.c_str(), out.c_str());
}

std::array<double, 2> range_of(const Arguments& given, const char* name) {
  const std::vector<double> ends = given.vector(name);
  if (!(ends[0] < ends[1])) throw InputError(text("'", name, "' goes from ", ends[0], " to ", ends[1], "; the first must be the lesser"));
  const char axis = name[0];
  if (ends[0] <= 0 && given.text("log").find(axis) != std::string::npos)
    throw InputError(text("'", name, "' begins at ", ends[0], ", which has no place on a logarithmic axis"));
  return {ends[0], ends[1]};
}

/// The least and greatest of the values that an axis can show; the first is the greater where there are none.
std::array<double, 2> ends_of(const std::vector<const std::vector<double>*>& data, bool log) {
  std::array<double, 2> ends{INFINITY, -INFINITY};
  for (const std::vector<double>* values : data)
    for (const double v : *values)
      if (std::isfinite(v) && (!log || v > 0)) ends = {std::min(ends[0], v), std::max(ends[1], v)};
  return ends;
}

/// Refuses axes on which nothing would be seen.
void check_seen(const figure::ChartPicture& chart) {
  std::vector<const std::vector<double>*> x, left, right;
  for (const SeriesPicture& s : chart.series) {
    x.insert(x.end(), {&s.x, &s.x_low, &s.x_high});
    std::vector<const std::vector<double>*>& y = s.right ? right : left;
    y.insert(y.end(), {&s.y, &s.low, &s.high});
  }
  for (const auto& [name, data, log, range] : {std::tuple{"'x_range'", x, chart.log_x, chart.x_range}, std::tuple{"'y_range'", left, chart.log_y, chart.y_range}}) {
    const auto [least, most] = ends_of(data, log);
    if (range && least <= most && ((*range)[1] < least || (*range)[0] > most))
      throw InputError(text(name, " goes from ", (*range)[0], " to ", (*range)[1], ", but the data from ", least, " to ", most));
  }
  if (!right.empty() && !(ends_of(right, chart.log_y)[0] < INFINITY)) throw InputError("no series on the axis on the right has a value that it can show");
  const bool strip = std::ranges::any_of(chart.series, [](const SeriesPicture& s) { return s.y.empty(); });
  if (chart.map || left.empty()) return;
  if (!(ends_of(x, chart.log_x)[0] < INFINITY) || (!strip && !(ends_of(left, chart.log_y)[0] < INFINITY))) throw InputError("no series has a point that the axes can show");
}

void read_chart(const Arguments& given, figure::ChartPicture& chart) {
  given.fill(chart);
  if (given.has("x_range")) chart.x_range = range_of(given, "x_range");
  if (given.has("y_range")) chart.y_range = range_of(given, "y_range");
  const std::string log = given.text("log");
  chart.log_x = log.find('x') != std::string::npos;
  chart.log_y = log.find('y') != std::string::npos;
  if (!given.has("series") && !given.has("map")) throw InputError("missing key 'series' or 'map'");
  for (const Arguments& series : given.tables("series")) chart.series.push_back(series_of(series));
  check_seen(chart);
  for (const Arguments& note : given.tables("notes")) chart.notes.push_back(note.filled<figure::ChartNote>());
  if (given.has("map")) chart.map = map_of(given.table("map"));
  if (given.has("slopes"))
    for (const double slope : given.vector("slopes")) chart.slopes.push_back({slope, ""});
}

// Panels one below the other; x given for all is one axis.
std::string chart_column(Call& call) {
  for (const Key& key : chart_keys())
    if (key.name != "title" && key.name != "x" && call.has(key.name)) throw InputError(text("'", key.name, "' beside 'panels'; give it within each panel"));
  figure::ChartColumn column;
  column.shared_x = call.has("x");
  for (const Arguments& panel : call.tables("panels")) {
    figure::ChartPicture& chart = column.panels.emplace_back();
    read_chart(panel, chart);
    if (column.shared_x && panel.has("x")) throw InputError(text("panel ", column.panels.size(), " has an 'x', but there is one for all panels; give one or the other"));
    if (column.shared_x) chart.x_label = call.text("x");
    if (column.shared_x && chart.log_x != column.panels.front().log_x)
      throw InputError(text("panel ", column.panels.size(), " is ", chart.log_x ? "" : "not ", "logarithmic in x, the first one is", chart.log_x ? " not" : "", ", but there is one x axis for all panels"));
  }
  if (call.has("columns")) column.columns = static_cast<int>(std::min<long long>(call.integer("columns"), column.panels.size() + 1));
  const int rows = (static_cast<int>(column.panels.size()) + column.columns - 1) / column.columns;
  column.height = 60 + 260 * rows;
  const std::string file = draw(call, column);
  for (const figure::ChartPicture& chart : column.panels) tell_not_shown(chart, file);
  return file;
}

std::string chart(Call& call) {
  if (call.has("panels")) return chart_column(call);
  if (!call.has("series") && !call.has("map")) throw InputError("missing key 'series', 'map' or 'panels'");
  if (call.has("columns")) throw InputError("'columns' without 'panels'");
  figure::ChartPicture picture;
  read_chart(call, picture);
  const std::string file = draw(call, picture);
  tell_not_shown(picture, file);
  return file;
}

std::vector<Key> figure_keys() {
  return joined(joined(joined({picture_key()}, chart_keys()),
                {key::list("panels", key::table("", chart_keys(), ""), "instead of all that but title and x: charts one below the other; an x beside them is one axis for all").count(1, 12),
                 key::integer("columns", "of the panels, which follow row by row").at_least(1).otherwise("1")}),
                size_keys("{1000, 750}; with panels {1000, 60 and 260 for each row}"));
}

}  // namespace

void bind_figure(Library& library) {
  library.function({.name = "dotyk.chart",
                    .help = "Draws curves into a file, in one chart or in panels one below the other (or in columns), and returns its name.",
                    .example = "dotyk.chart{ file = \"a.png\", x = \"h\", y = \"error\", log = \"xy\", slopes = { 1, 2 },\n"
                               "  series = { { name = \"P1\", x = { 1, 0.5 }, y = { 0.1, 0.03 } } } }",
                    .arguments = {key::table(figure_keys())},
                    .run = chart});
  bind_picture(library);
}

}  // namespace dotyk::script

#include <tuple>

#include "base/error.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

void check_texts(const ChartPicture& p) {
  check_text("'title'", p.title);
  check_text("'x'", p.x_label);
  check_text("'y'", p.y_label);
  check_text("'y_right'", p.y_right_label);
  check_text("'strip'", p.strip_label);
  for (std::size_t k = 0; k < p.series.size(); ++k) check_text(text("'name' of series ", k + 1), p.series[k].name);
  for (std::size_t k = 0; k < p.categories.size(); ++k) check_text(text("category ", k + 1), p.categories[k]);
  for (std::size_t k = 0; k < p.notes.size(); ++k) check_text(text("'text' of note ", k + 1), p.notes[k].text);
}

void check_series(const SeriesPicture& s) {
  const std::string who = "series \"" + s.name + "\"";
  require(s.x.size() == s.y.size() || (s.crossed && s.y.empty()), who, ": ", s.x.size(), " x for ", s.y.size(), " y");
  require(!s.y.empty() || (s.low.empty() && s.x_low.empty()), who + ": points without y have no spread and no whiskers");
  const auto spread = [&](const std::vector<double>& low, const std::vector<double>& high) {
    return low.size() == high.size() && (low.empty() || low.size() == s.x.size());
  };
  require(spread(s.low, s.high), who, ": the spread needs as many low and high values as points");
  require(spread(s.x_low, s.x_high), who, ": whiskers need as many x_low and x_high values as points");
  if (s.bars && s.low.empty()) throw InputError(who + ": 'bars' without 'low' and 'high'");
}

void check_grid(const std::vector<double>& at, const char* name, bool log) {
  require(!at.empty() && finite(at), "'map': ", name, " needs finite values, one at least");
  for (std::size_t i = 1; i < at.size(); ++i)
    if (!(at[i] > at[i - 1])) throw InputError(text("'map': ", name, " must ascend; ", at[i], " follows ", at[i - 1]));
  if (log && !(at[0] > 0)) throw InputError(text("'map': ", name, " begins at ", at[0], ", which has no place on a logarithmic axis"));
}

void check_map(const ChartMap& map, const ChartPicture& p) {
  for (const std::string& words : {map.label, map.unit}) check_text("'map'", words);
  for (const std::string& name : map.names) check_text("'names' of 'map'", name);
  check_grid(map.x, "x", p.log_x);
  check_grid(map.y, "y", p.log_y);
  require(map.values.size() == map.x.size() * map.y.size(), "'map': ", map.values.size(), " values for ", map.x.size(), " x and ", map.y.size(), " y");
  require(map.names.size() <= most_map_names, "'map': ", map.names.size(), " names; at most ", most_map_names, " can be told apart");
  if (map.names.empty() == map.label.empty()) throw InputError("'map' needs a 'label' for the colour bar, or 'names' for its values, and not both");
  for (const double v : map.values) {
    if (std::isnan(v)) continue;
    require(std::isfinite(v), "'map': a value is infinite");
    if (!map.names.empty() && !(v == std::floor(v) && v >= 1 && v <= static_cast<double>(map.names.size())))
      throw InputError(text("'map': the value ", v, " has no name; with ", map.names.size(), " names values are 1 to ", map.names.size(), ", or nan"));
  }
}

void check_break(const ChartPicture& p) {
  const auto [from, to] = *p.y_break;
  const std::string what = text("'y_break' from ", from, " to ", to);
  if (!(finite(from, to) && from < to)) throw InputError(what + "; the first must be the lesser");
  if (p.log_y) throw InputError(what + " on a logarithmic axis; only a linear one can be broken");
  if (p.polar || p.map || !p.slopes.empty()) throw InputError(what + " together with 'polar', 'map' or 'slopes'");
  double least = INFINITY, most = -INFINITY;
  for (const SeriesPicture& s : p.series) {
    if (s.right) throw InputError(what + " together with an axis on the right");
    for (const double y : s.y)
      if (std::isfinite(y)) least = std::min(least, y), most = std::max(most, y);
  }
  for (const ChartNote& note : p.notes)
    if (note.y > from && note.y < to) throw InputError(text(what, " leaves out the point of the note \"", note.text, "\", y = ", note.y));
  if (p.y_range) least = (*p.y_range)[0], most = (*p.y_range)[1];
  if (!(least < from && most > to)) throw InputError(text(what, " must lie within the y axis, from ", least, " to ", most));
}

void check_polar(const ChartPicture& p) {
  if (p.log_x || p.log_y) throw InputError("'polar' together with 'log'; angles and radii are linear");
  for (const auto& [there, name] : {std::tuple{p.x_range.has_value(), "x_range"}, {p.y_range.has_value(), "y_range"}, {!p.slopes.empty(), "slopes"}, {!p.categories.empty(), "categories"}})
    if (there) throw InputError(text("'polar' together with '", name, "'; angles go once around, and radii from 0 to the greatest"));
  for (const SeriesPicture& s : p.series) {
    const std::string who = "series \"" + s.name + "\"";
    if (s.right || (s.y.empty() && !s.x.empty())) throw InputError(who + (s.right ? ": 'axis' is \"right\"" : ": no 'y'") + ", which has no place in a polar chart");
    if (!s.low.empty() || !s.x_low.empty()) throw InputError(who + ": no spread and no whiskers in a polar chart");
    for (const double r : s.y)
      if (r < 0) throw InputError(text(who, ": the radius ", r, " is negative"));
  }
  if (p.map && p.map->y.front() < 0) throw InputError(text("'map': the radius ", p.map->y.front(), " is negative"));
}

void check_axes(const ChartPicture& p) {
  for (const auto& [range, log, name] : {std::tuple{p.x_range, p.log_x, "x"}, std::tuple{p.y_range, p.log_y, "y"}})
    if (range)
      require(finite(*range) && (*range)[0] < (*range)[1] && (!log || (*range)[0] > 0),
              "the range of the ", name, " axis must be {least, greatest}", log ? ", both positive" : "");
  const bool right = std::ranges::any_of(p.series, &SeriesPicture::right), left = !std::ranges::all_of(p.series, &SeriesPicture::right);
  if (right && !left) throw InputError("every series has its axis on the right; one must be on the left");
  if (!right && !p.y_right_label.empty()) throw InputError("'y_right' without a series whose 'axis' is \"right\"");
  if (!p.categories.empty() && (p.log_x || p.x_range)) throw InputError("'categories' together with a logarithmic x axis or 'x_range'; they have x = 1, 2, …");
  if (p.map && (p.x_range || p.y_range || right)) throw InputError("'map' together with 'x_range', 'y_range' or an axis on the right; its cells are the range");
  if (p.y_break) check_break(p);
  if (p.polar) check_polar(p);
}

void check_chart(const ChartPicture& p) {
  check_texts(p);
  for (const SeriesPicture& s : p.series) check_series(s);
  if (p.map) check_map(*p.map, p);
  for (const SlopeGuide& guide : p.slopes) require(std::isfinite(guide.slope), "the slope of a guide is not finite");
  for (const ChartNote& note : p.notes) {
    require(finite(note.x, note.y), "a note has a coordinate that is not finite");
    if ((p.log_x && note.x <= 0) || (p.log_y && note.y <= 0)) throw InputError("the note \"" + note.text + "\" has no place on a logarithmic axis");
  }
  check_axes(p);
}

}  // namespace

void check(const ChartPicture& p) {
  check_sheet(p);
  check_chart(p);
}

void check(const ChartColumn& p) {
  check_sheet(p);
  require(!p.panels.empty(), "the picture " + p.file + " has no panels");
  require(p.columns >= 1 && p.columns <= static_cast<int>(p.panels.size()), p.panels.size(), " panels in ", p.columns, " columns");
  for (const ChartPicture& panel : p.panels) {
    check_chart(panel);
    require(!p.shared_x || panel.log_x == p.panels.front().log_x, "panels that share the x axis are all logarithmic in x, or none is");
    require(!p.shared_x || panel.categories == p.panels.front().categories, "panels that share the x axis have the same categories");
    require(!p.shared_x || !panel.polar, "panels that share the x axis are not polar");
  }
}

}  // namespace dotyk::figure

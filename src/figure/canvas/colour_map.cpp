#include "figure/canvas/colour_map.hpp"

#include <iterator>

namespace dotyk::figure {

namespace {

using Anchors = std::array<Colour, 11>;

// Viridis (van der Walt & Smith, matplotlib) at tenths.
constexpr Anchors viridis{{{68, 1, 84}, {72, 36, 117}, {65, 68, 135}, {53, 95, 141}, {42, 120, 142}, {33, 145, 140},
                           {34, 168, 132}, {68, 191, 112}, {122, 209, 81}, {189, 223, 38}, {253, 231, 37}}};
// RdBu (Brewer) from blue to red.
constexpr Anchors blue_red{{{5, 48, 97}, {33, 102, 172}, {67, 147, 195}, {146, 197, 222}, {209, 229, 240}, {247, 247, 247},
                            {253, 219, 199}, {244, 165, 130}, {214, 96, 77}, {178, 24, 43}, {103, 0, 31}}};

Colour mix(const Anchors& anchors, double t) {
  const double s = 10 * std::clamp(t, 0.0, 1.0);
  const int i = std::min(9, static_cast<int>(s));
  const double f = s - i;
  const auto blend = [f](unsigned char a, unsigned char b) { return static_cast<unsigned char>(std::lround(a + f * (b - a))); };
  const Colour a = anchors[i], b = anchors[i + 1];
  return {blend(a.r, b.r), blend(a.g, b.g), blend(a.b, b.b)};
}

// "stress [MPa]", "slip [10⁶ mm]": the power of ten stands with the unit.
std::string label(const FieldLabel& field, int exponent) {
  const std::string unit = (exponent && field.unit.empty() ? "× " : "") + scaled_unit(field.unit, exponent);
  return unit.empty() ? field.name : field.name + " [" + unit + "]";
}

// As many of the ticks as have room on a bar of this height.
std::vector<Tick> ticks_on(const ColourScale& scale, double height, double em) {
  const auto apart = [&](const std::vector<double>& at) { return at.size() < 2 || (at[1] - at[0]) / (scale.high - scale.low) * height >= 1.1 * em; };
  Ticks out = bar_ticks(scale);
  for (int n = 4; n >= 2 && !apart(out.labelled()); --n) out = linear_ticks(scale.low, scale.high, n);
  return out.ticks;
}

// The width of the longest word.
double longest_word(const std::string& name, double size) {
  double most = 0;
  for (std::size_t from = 0; from < name.size();) {
    const std::size_t end = std::min(name.find(' ', from), name.size());
    most = std::max(most, text_extent(name.substr(from, end - from), size).x);
    from = end + 1;
  }
  return most;
}

constexpr double bar = 1.0, tick = 0.25, pad = 0.35, small_label = 0.85, ends = 0.55, tip = 0.9;  // in em

// Values that are not at nodes of bodies.
std::vector<const std::vector<double>*> fields_beside(const ScenePicture& p) {
  std::vector<const std::vector<double>*> out;
  for (const BodyPicture& body : p.bodies) out.push_back(&body.cell_values);
  for (const ContactPicture& contact : p.contacts) out.push_back(&contact.values);
  return out;
}

// At the nodes that are seen, and beside them.
std::vector<double> values_of(const ScenePicture& p, const std::optional<Box>& window) {
  std::vector<double> out;
  for (const BodyPicture& body : p.bodies)
    for (std::size_t i = 0; i < body.values.size(); ++i) {
      const Vec3 at = body.node(i, p.deformation);
      if (std::isfinite(body.values[i]) && (!window || window->holds({at[0], at[1]}))) out.push_back(body.values[i]);
    }
  for (const auto* values : fields_beside(p))
    std::ranges::copy_if(*values, std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

// With three digits, or as many as are needed to tell values within the bar's range apart.
std::string extreme(const char* name, double value, const ColourScale& scale, const Ticks& ticks) {
  const double apart = std::abs(value) / std::max(scale.high - scale.low, 1e-300);
  const int digits = std::clamp(2 + static_cast<int>(std::ceil(std::log10(std::max(apart, 1.0)))), 3, 9);
  return std::string(name) + " " + scaled_number(value, ticks.exponent, digits);
}

// Whether the extreme is at a singular point: no node that shares a cell with it has nearly as much. True of values that are not at nodes.
bool is_singular(const ScenePicture& p, double extreme) {
  constexpr double kNearly = 0.8;
  double nearest = 0;
  for (const BodyPicture& body : p.bodies) {
    const auto& cells = body.dimension == 2 ? body.cells : body.facets;
    const std::size_t corners = body.dimension == 2 ? nodes_per_cell(body.shape, 1) : body.nodes_per_facet;
    for (std::size_t c = 0; c < cells.size() && !body.values.empty(); c += corners) {
      const std::span cell(cells.data() + c, corners);
      if (std::ranges::none_of(cell, [&](int n) { return body.values[n] == extreme; })) continue;
      for (const int n : cell)
        if (body.values[n] != extreme) nearest = std::max(nearest, body.values[n] / extreme);
    }
  }
  return nearest < kNearly;
}

}  // namespace

void leave_out_peaks(ColourScale& scale, std::vector<double> values) {
  constexpr double kShare = 0.01, kFar = 1.5, kNothing = 0.02;
  const double range = scale.high - scale.low;
  const std::size_t beyond = static_cast<std::size_t>(kShare * static_cast<double>(values.size()));
  if (beyond == 0) return;
  const auto shorten = [&](double& end, std::size_t place) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), at, values.end());
    const bool same_side = *at * end > 0;
    if (same_side && std::abs(end) > kFar * std::abs(*at) && std::abs(end - *at) > kNothing * range) end = *at;
  };
  shorten(scale.high, values.size() - 1 - beyond);
  shorten(scale.low, beyond);
}

Ticks bar_ticks(const ColourScale& scale) { return few_ticks(scale.low, scale.high, 5); }

double ColourScale::from() const { return diverging ? -to() : low; }
double ColourScale::to() const { return diverging ? std::max(std::abs(low), std::abs(high)) : high; }

Colour ColourScale::at(double value) const {
  const double a = from(), b = to();
  return mix(diverging ? blue_red : viridis, b > a ? (value - a) / (b - a) : 0.5);
}

ColourScale colour_scale(const ScenePicture& p, const std::optional<Box>& window) {
  ColourScale scale;
  Seen part;
  if (window && p.bodies.front().dimension == 2) {
    part = seen(p, *window);
  } else {
    for (const BodyPicture& body : p.bodies)
      for (const double v : body.values) part.add(v);
    for (const auto* values : fields_beside(p))
      for (const double v : *values) part.add(v);
  }
  scale.shown = part.least <= part.greatest;
  if (!scale.shown) return scale;
  constexpr double kRounding = 1e-12;
  if (std::abs(part.least) < kRounding * part.greatest) part.least = 0;
  if (std::abs(part.greatest) < -kRounding * part.least) part.greatest = 0;
  scale.least = scale.low = part.least, scale.greatest = scale.high = part.greatest;
  if (p.field_range) scale.low = (*p.field_range)[0], scale.high = (*p.field_range)[1];
  else leave_out_peaks(scale, values_of(p, window));
  for (const auto& [end, extreme] : {std::pair{&scale.low, part.least}, std::pair{&scale.high, part.greatest}})
    if (!p.field_range && *end != extreme && !is_singular(p, extreme)) *end = extreme;
  constexpr double kNearZero = 0.5;
  if (!p.field_range && !p.field_signed && scale.low > 0 && scale.low < kNearZero * scale.high) scale.low = 0;
  // A field without sign may dip below zero by rounding, or by recovery.
  const double lesser = std::min(-scale.low, scale.high), greater = std::max(-scale.low, scale.high);
  scale.diverging = p.field_signed || lesser > 0.02 * greater;
  if (!(scale.high - scale.low > 1e-6 * std::max(std::abs(scale.low), std::abs(scale.high)))) {
    // A constant field has a bar of some height around it. Zero is the lower end of the bar if the field cannot be negative.
    const double half = scale.low == 0 ? 1 : 0.1 * std::abs(scale.low);
    scale.low -= scale.low == 0 && !p.field_signed ? 0 : half, scale.high += half;
  }
  return scale;
}

vtkSmartPointer<vtkLookupTable> lookup_table(const ColourScale& scale) {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  constexpr int n = 1024;
  table->SetNumberOfTableValues(n);
  table->SetTableRange(scale.from(), scale.to());
  for (int i = 0; i < n; ++i) {
    const Colour c = scale.at(scale.from() + (scale.to() - scale.from()) * (i + 0.5) / n);
    table->SetTableValue(i, c.r / 255.0, c.g / 255.0, c.b / 255.0, 1);
  }
  table->SetNanColor(0.85, 0.85, 0.85, 1);
  return table;
}

double colour_bar_width(const ColourScale& scale, const FieldLabel& field, double em) {
  if (!scale.shown || field.name.empty()) return 0;
  const Ticks ticks = bar_ticks(scale);
  const double beside = (bar + tick + pad) * em + widest_label(ticks, em) + 0.4 * em + 1.3 * em;
  const auto above = [&](const char* name, double value) { return text_extent(extreme(name, value, scale, ticks), small_label * em).x; };
  return std::max({beside, above("max", scale.greatest), above("min", scale.least), longest_word(label(field, ticks.exponent), least_letters * em)});
}

double least_bar_height(const ColourScale& scale, const FieldLabel& field, double em, double width) {
  constexpr double kBox = 6;  // em, of the colours
  const int tips = (scale.least < scale.low) + (scale.greatest > scale.high);
  return (kBox + tip * tips + 2 * (ends + 1.0) + 1.3) * em + fitted(label(field, bar_ticks(scale).exponent), em, width).depth();
}

void draw_colour_bar(Canvas& canvas, const ColourScale& scale, const FieldLabel& field, double em, const Box& room) {
  const double left = room.left, bottom = room.bottom;
  double top = room.top;
  const Ticks ticks = bar_ticks(scale);
  // The name stands beside the bar, above it where that is too short.
  const std::string name = label(field, ticks.exponent);
  const bool upright = text_extent(name, least_letters * em).x <= top - bottom - 2 * (ends + 1.0) * em;
  if (!upright) {
    const FittedText lines = fitted(name, em, room.width());
    canvas.text({left, top}, lines, {.up = Align::high});
    top -= lines.depth() + 1.3 * em;
  }
  // Where the field goes on beyond an end of the bar, a triangle in the colour of that end says so.
  const double tip_below = scale.least < scale.low ? tip * em : 0, tip_above = scale.greatest > scale.high ? tip * em : 0;
  const Box box{left, bottom + (ends + 1.0) * em + tip_below, left + bar * em, top - (ends + 1.0) * em - tip_above};
  const int n = std::max(2, static_cast<int>(box.height()));
  for (int i = 0; i < n; ++i) {
    const double y = box.bottom + box.height() * i / n;
    canvas.box({box.left, y, box.right, box.top}, scale.at(scale.low + (scale.high - scale.low) * (i + 0.5) / n));
  }
  canvas.outline(box, std::max(1.0, em / 22), {60, 60, 60});
  for (const auto& [foot, height, value] : {std::tuple{box.bottom, -tip_below, scale.low}, std::tuple{box.top, tip_above, scale.high}}) {
    if (height == 0) continue;
    const std::array<Point, 3> corners{{{box.left, foot}, {box.right, foot}, {box.centre().x, foot + height}}};
    canvas.convex(corners, scale.at(value));
    canvas.polyline(corners, std::max(1.0, em / 22), {60, 60, 60}, {}, true);
  }
  for (const Tick& t : ticks_on(scale, box.height(), em)) {
    const double y = box.bottom + box.height() * (t.value - scale.low) / (scale.high - scale.low);
    if (t.label.empty()) continue;
    canvas.line({box.right, y}, {box.right + tick * em, y}, std::max(1.0, em / 20), {60, 60, 60});
    canvas.text({box.right + (tick + pad) * em, y}, t.label, {.size = em, .up = Align::middle});
  }
  TextStyle end{.size = small_label * em, .colour = {70, 70, 70}};
  canvas.text({box.left, box.top + tip_above + ends * em}, extreme("max", scale.greatest, scale, ticks), end);
  end.up = Align::high;
  canvas.text({box.left, box.bottom - tip_below - ends * em}, extreme("min", scale.least, scale, ticks), end);
  if (upright)
    canvas.text({box.right + (tick + pad) * em + widest_label(ticks, em) + 0.4 * em, box.centre().y}, name,
                {.size = fitting_size(name, em, box.height()), .up = Align::middle, .upright = true});
}

}  // namespace dotyk::figure

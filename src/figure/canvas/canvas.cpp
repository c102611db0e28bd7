#include "figure/canvas/canvas.hpp"

#include <cctype>
#include <memory>
#include <numbers>
#include <optional>

#include "figure/canvas/font.hpp"

namespace dotyk::figure {
namespace {

bool is_finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::vector<Point> moved(std::span<const Point> points, Point by) {
  std::vector<Point> out;
  for (const Point& p : points) out.push_back(p + by);
  return out;
}

// The parts of the line in the box.
std::vector<std::vector<Point>> cropped_line(std::span<const Point> path, const Box& box) {
  std::vector<std::vector<Point>> parts;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Point p = path[i], q = path[i + 1];
    if (!crop(p, q, box)) {
      goes_on = false;
      continue;
    }
    if (!goes_on) parts.push_back({p});
    parts.back().push_back(q);
    goes_on = box.holds(path[i + 1]);
  }
  return parts;
}

constexpr double line_height = 1.25;  // of the letters

// Where characters begin, and the end.
std::vector<std::size_t> boundaries(const std::string& text) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) out.push_back(i);
  out.push_back(text.size());
  return out;
}

// The longest beginning, of whole characters, that fits with `end` after it.
std::string beginning(const std::string& text, const std::string& end, double size, double pixels, bool bold) {
  const std::vector<std::size_t> at = boundaries(text);
  std::size_t fits = 0, over = at.size();
  while (over - fits > 1) {
    const std::size_t middle = (fits + over) / 2;
    (text_extent(text.substr(0, at[middle]) + end, size, bold).x <= pixels ? fits : over) = middle;
  }
  return text.substr(0, at[fits]);
}

double width_of(const std::string& text, double size, bool bold) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> nowhere(cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr(cairo_create(nowhere.get()), cairo_destroy);
  set_font(cr.get(), size, bold);
  cairo_text_extents_t extent;
  cairo_text_extents(cr.get(), text.c_str(), &extent);
  return extent.x_advance;
}

// Is the character that begins here part of a word? In UTF-8 Latin and Greek letters have two bytes, signs as ‖ and − three.
bool is_word(const std::string& text, std::size_t at) {
  const auto c = static_cast<unsigned char>(text[at]);
  return std::isalnum(c) || c == '_' || (c >= 0xc3 && c < 0xe0);
}

std::size_t character_before(const std::string& text, std::size_t at) {
  while (at > 0 && (static_cast<unsigned char>(text[--at]) & 0xc0) == 0x80) {}
  return at;
}

// An index of a symbol, from "_" to `end`.
struct Index {
  std::size_t bar, end;
  std::string text;
};

// Finds the next index: after "_" either any text in braces, or one to five letters or digits. The latter counts only after a single letter,
// so that names of methods stay as they are.
std::optional<Index> find_index(const std::string& text, std::size_t from) {
  for (std::size_t bar = text.find('_', from); bar != std::string::npos; bar = text.find('_', bar + 1)) {
    if (const std::size_t close = text.find('}', bar); text[bar + 1] == '{' && close != std::string::npos) return Index{bar, close + 1, text.substr(bar + 2, close - bar - 2)};
    const std::size_t letter = character_before(text, bar);
    if (bar == from || !is_word(text, letter) || text[letter] == '_' || (letter > 0 && is_word(text, character_before(text, letter)))) continue;
    std::size_t end = bar + 1;
    while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end]))) ++end;
    if (end > bar + 1 && end <= bar + 6 && (end == text.size() || !is_word(text, end))) return Index{bar, end, text.substr(bar + 1, end - bar - 1)};
  }
  return std::nullopt;
}

}  // namespace

void Canvas::convex(std::span<const Point> corners, Colour colour, double opacity) {
  if (!std::ranges::all_of(corners, is_finite)) return;
  const bool inside = !clipped_ || std::ranges::all_of(corners, [&](Point p) { return clip_.holds(p); });
  std::vector<Point> rest(corners.begin(), corners.end());
  if (!inside) rest = cropped(std::move(rest), clip_);
  if (rest.size() > 2) add({Mark::Kind::polygon, moved(rest, origin_), colour, opacity});
}

void Canvas::box(const Box& b, Colour colour, double opacity) { convex(b.corners(), colour, opacity); }

void Canvas::outline(const Box& b, double width, Colour colour) { polyline(b.corners(), width, colour, {}, true); }

void Canvas::line(Point p, Point q, double width, Colour colour, double opacity) {
  if (!is_finite(p) || !is_finite(q) || (clipped_ && !crop(p, q, clip_)) || !(length(q - p) > 0)) return;
  add({Mark::Kind::line, {p + origin_, q + origin_}, colour, opacity, width});
}

void Canvas::polyline(std::span<const Point> points, double width, Colour colour, std::span<const double> dash, bool closed) {
  if (!std::ranges::all_of(points, is_finite)) return;
  // Points closer than a quarter of a pixel do not show.
  std::vector<Point> path;
  for (const Point& p : points)
    if (path.empty() || length(p - path.back()) > 0.25) path.push_back(p);
  if (!points.empty() && path.size() > 1) path.back() = points.back();
  if (path.size() < 2) return;
  const std::vector<double> dashes(dash.begin(), dash.end());
  if (!clipped_ || std::ranges::all_of(path, [&](Point p) { return clip_.holds(p); }))
    return add({Mark::Kind::line, moved(path, origin_), colour, 1, width, dashes, closed && path.size() > 2});
  // What lies outside is neither drawn nor dashed: it may be very long.
  if (closed && path.size() > 2) path.push_back(path.front());
  for (const std::vector<Point>& part : cropped_line(path, clip_)) add({Mark::Kind::line, moved(part, origin_), colour, 1, width, dashes});
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  if (!is_finite(centre)) return;
  if (!clipped_ || clip_.holds(centre, -radius)) return add({Mark::Kind::disc, {centre + origin_}, colour, 1, radius});
  std::vector<Point> corners;
  constexpr int kCorners = 64;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    corners.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  convex(corners, colour);
}

void Canvas::marker(Marker kind, Point c, double size, Colour colour) {
  const Colour white{255, 255, 255};
  const double rim = std::max(0.8, size / 12), r = size / 2;
  const auto at = [&](double x, double y, double s) { return Point{c.x + s * x, c.y + s * y}; };
  const auto shape = [&](std::initializer_list<Point> corners, double grow) {
    for (const auto& [s, paint] : {std::pair{r * grow + rim * 1.3, white}, std::pair{r * grow, colour}}) {
      std::vector<Point> moved;
      for (const Point& p : corners) moved.push_back(at(p.x, p.y, s));
      convex(moved, paint);
    }
  };
  switch (kind) {
    case Marker::disc:
      disc(c, r + rim, white);
      disc(c, r, colour);
      break;
    case Marker::ring:
      disc(c, r + rim, white);
      disc(c, r, colour);
      disc(c, r - std::max(1.2, size / 5), white);
      break;
    case Marker::square: shape({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 0.88); break;
    case Marker::triangle: shape({{-0.95, -0.6}, {0.95, -0.6}, {0, 1.05}}, 1.12); break;
    case Marker::down_triangle: shape({{0, -1.05}, {0.95, 0.6}, {-0.95, 0.6}}, 1.12); break;
    case Marker::diamond: shape({{0, -1}, {1, 0}, {0, 1}, {-1, 0}}, 1.2); break;
    case Marker::plus:
    case Marker::cross: {
      const double d = kind == Marker::plus ? 0 : std::numbers::pi / 4;
      for (const auto& [w, paint, l] : {std::tuple{size / 3.2 + 2 * rim, white, r * 1.1 + rim}, std::tuple{size / 3.2, colour, r * 1.1}})
        for (const double a : {d, d + std::numbers::pi / 2})
          line({c.x - l * std::cos(a), c.y - l * std::sin(a)}, {c.x + l * std::cos(a), c.y + l * std::sin(a)}, w, paint);
      break;
    }
  }
}

Marker status_marker(Status status) {
  switch (status) {
    case Status::open: return Marker::ring;
    case Status::closed: return Marker::disc;
    case Status::stick: return Marker::square;
    case Status::slip: return Marker::triangle;
  }
  return Marker::disc;
}

void Canvas::crossed_marker(Marker kind, Point c, double size, Colour colour) {
  const auto pale = [](unsigned char value) { return static_cast<unsigned char>(255 - (255 - value) / 3); };
  marker(kind, c, 1.2 * size, {pale(colour.r), pale(colour.g), pale(colour.b)});
  const double arm = 0.55 * size;
  for (const double side : {-1.0, 1.0}) line({c.x - arm, c.y - side * arm}, {c.x + arm, c.y + side * arm}, 0.16 * size, colour);
}

void Canvas::arrow(Point tail, Point head, double width, double head_length, Colour colour, double rim) {
  const double size = length(head - tail);
  if (!(size > 0)) return;
  const double tip = std::min(head_length, 0.6 * size), half = 0.38 * tip;
  const Point d{(head.x - tail.x) / size, (head.y - tail.y) / size}, across{-d.y, d.x}, neck = head - tip * d;
  if (rim > 0) {
    const Colour white{255, 255, 255};
    const double grown = (half + rim) / half * half;
    line(tail - rim * d, neck, width + 2 * rim, white);
    convex(std::array{neck - rim * d + grown * across, neck - rim * d - grown * across, head + 2 * rim * d}, white);
  }
  line(tail, head - 0.9 * tip * d, width, colour);
  convex(std::array{neck + half * across, neck - half * across, head}, colour);
}

void set_font(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr, font_family, CAIRO_FONT_SLANT_NORMAL, bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(cairo_font_options_create(), cairo_font_options_destroy);
  // Alike whatever the system prefers, and as wide on paper as on the screen.
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cr, options.get());
}

std::vector<TextRun> text_runs(const std::string& text, double size, bool bold, double least) {
  constexpr double kLower = 0.22;
  std::vector<TextRun> runs;
  double at = 0;
  const auto add = [&](const std::string& piece, double letters, double up) {
    if (piece.empty()) return;
    runs.push_back({piece, letters, width_of(piece, letters, bold), {at, up}});
    at += runs.back().width;
  };
  std::size_t from = 0;
  while (const auto index = find_index(text, from)) {
    add(text.substr(from, index->bar - from), size, 0);
    add(index->text, std::min(size, std::max(least_letters * size, least)), -kLower * size);
    from = index->end;
  }
  add(text.substr(from), size, 0);
  return runs;
}

Point text_extent(const std::string& text, double size, bool bold) {
  if (text.empty()) return {0, 0};
  const TextRun last = text_runs(text, size, bold).back();
  return {last.start.x + last.width, (font_ascent + font_descent) * size};
}

Point baseline(const PlacedText& text) {
  const auto shift = [](Align align, double size) { return align == Align::low ? 0 : align == Align::middle ? -size / 2 : -size; };
  const TextStyle& style = text.style;
  const Point extent = text_extent(text.text, style.size, style.bold);
  // Along an upright text "across" and "up" are those of the page.
  if (style.upright) return text.at + Point{shift(style.across, extent.y) + font_ascent * style.size, shift(style.up, extent.x)};
  return text.at + Point{shift(style.across, extent.x), shift(style.up, extent.y) + font_descent * style.size};
}

double fitting_size(const std::string& text, double size, double pixels, bool bold) {
  const double width = text_extent(text, size, bold).x;
  return width > pixels ? std::max(least_letters * size, size * pixels / width) : size;
}

std::string shortened(const std::string& text, double size, double pixels, bool bold) {
  if (text_extent(text, size, bold).x <= pixels) return text;
  std::string out = beginning(text, "…", size, pixels, bold);
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out + "…";
}

FittedText fitted(const std::string& text, double size, double pixels, bool bold, const std::string& end) {
  constexpr std::size_t kLines = 3;
  FittedText out{fitting_size(text + end, size, pixels, bold), {}};
  const auto width = [&](const std::string& line) { return text_extent(line, out.size, bold).x; };
  const auto fits = [&](const std::string& line) { return width(line) <= pixels + 1e-6 * size; };
  std::string rest = text;
  while (!fits(rest + end) && out.lines.size() + 1 < kLines) {
    std::string line = beginning(rest, "", out.size, pixels, bold);
    const std::size_t space = rest.find_last_of(" \n", line.size());
    if (space != std::string::npos && space > 0) line.resize(space);
    out.lines.push_back(line);
    rest.erase(0, std::min(rest.find_first_not_of(" \n", line.size()), rest.size()));
  }
  out.lines.push_back((fits(rest + end) ? rest : shortened(rest, out.size, pixels - width(end), bold)) + end);
  if (out.lines.size() == 1) return out;
  // Two lines: broken at the first space after which the second is no longer than the first.
  if (out.lines.size() == 2 && fits(rest + end))
    for (std::size_t at = text.find_first_of(" \n"); at != std::string::npos; at = text.find_first_of(" \n", at + 1))
      if (width(text.substr(0, at)) >= width(text.substr(at + 1) + end)) {
        if (fits(text.substr(0, at))) out.lines = {text.substr(0, at), text.substr(at + 1) + end};
        break;
      }
  double widest = 0;
  for (const std::string& line : out.lines) widest = std::max(widest, width(line));
  if (bold) out.size = std::min(size, out.size * pixels / widest);
  return out;
}

TextStyle title_style() { return {.across = Align::middle, .up = Align::high, .bold = true}; }

double FittedText::depth() const { return static_cast<double>(lines.size() - 1) * line_height * size; }

void Canvas::text(Point at, const std::string& text, const TextStyle& style) {
  if (!text.empty()) texts_.push_back({{origin_.x + at.x, origin_.y + at.y}, text, style});
}

void Canvas::text(Point first, const FittedText& lines, TextStyle style) {
  style.size = lines.size;
  for (const std::string& line : lines.lines) {
    text(first, line, style);
    (style.upright ? first.x : first.y) += (style.upright ? 1 : -1) * line_height * lines.size;
  }
}

Point extent_of(const FittedText& text) {
  Point out{0, text_extent(text.lines[0], text.size).y + text.depth()};
  for (const std::string& line : text.lines) out.x = std::max(out.x, text_extent(line, text.size).x);
  return out;
}

}  // namespace dotyk::figure

#include "figure/canvas/text_fit.hpp"

#include <algorithm>

namespace dotyk::figure {

namespace {

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

}  // namespace

std::string shortened(const std::string& text, double size, double pixels, bool bold) {
  if (text_extent(text, size, bold).x <= pixels) return text;
  std::string out = beginning(text, "…", size, pixels, bold);
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out + "…";
}

FittedText fitted(const std::string& text, double size, double pixels, bool bold, const std::string& end) {
  const double smaller = fitting_size(text + end, size, pixels, bold);
  // Letters are of whole pixels, so the smaller text may be a little wider; its place has a margin.
  if (text_extent(text + end, smaller, bold).x <= pixels + 0.5 * size) return {smaller, {text + end}};
  std::string first = beginning(text, "", smaller, pixels, bold);
  const std::size_t space = text.find_last_of(" \n", first.size());
  if (space != std::string::npos && space > 0) first.resize(space);
  const std::size_t rest = std::min(text.find_first_not_of(" \n", first.size()), text.size());
  return {smaller, {first, shortened(text.substr(rest), smaller, pixels - text_extent(end, smaller, bold).x, bold) + end}};
}

double widest_label(const Ticks& ticks, double size) {
  double widest = 0;
  for (const Tick& t : ticks.ticks) widest = std::max(widest, text_extent(t.label, size).x);
  return widest;
}

TextStyle title_style() { return {.across = Align::middle, .up = Align::high, .bold = true}; }

void draw_lines(Canvas& canvas, Point first, const FittedText& text, TextStyle style) {
  style.size = text.size;
  for (const std::string& line : text.lines) {
    canvas.text(first, line, style);
    (style.upright ? first.x : first.y) += (style.upright ? 1 : -1) * line_height * text.size;
  }
}

double depth(const FittedText& text) { return static_cast<double>(text.lines.size() - 1) * line_height * text.size; }

}  // namespace dotyk::figure

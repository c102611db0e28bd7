// Flat drawing in the pixels of the finished picture: origin at the lower
// left, y upwards. A canvas keeps what is drawn on it, in the order of the
// calls; texts lie above everything. paper.hpp puts it into a file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "figure/canvas/plane.hpp"
#include "figure/door/marks.hpp"

namespace dotyk::figure {

constexpr Colour load_colour{0, 70, 110};  // of arrows of loads

enum class Align { low, middle, high };  // which end of the text stands at its point

struct TextStyle {
  double size = 20;  // pixels
  Align across = Align::low, up = Align::low;
  bool upright = false;  // turned by 90 degrees, read from below
  bool bold = false;
  Colour colour = {20, 20, 20};
  bool halo = false;  // white rim, for texts on a coloured ground
};

// Of titles: bold, centred, hanging from their place.
TextStyle title_style();

// Width and height in pixels of a line of text, not turned.
Point text_extent(const std::string& text, double size, bool bold = false);

// The size at which the text fits into so many pixels: at most `size`, and no
// less than this share of it, so that letters stay legible.
constexpr double least_letters = 0.85;
double fitting_size(const std::string& text, double size, double pixels, bool bold = false);

// The text, or its beginning and "…", no wider than so many pixels.
std::string shortened(const std::string& text, double size, double pixels, bool bold = false);

struct FittedText {
  double size = 20;  // of the letters, pixels
  std::vector<std::string> lines;
  double depth() const;  // from the first line to the last
};
Point extent_of(const FittedText& text);

// Breaks a text between words so that no line is wider than `pixels`. It stays in one line if letters of least_letters × `size` make it
// fit; else it has two lines of about the same width, or three. If three do not suffice, the last is shortened, but keeps `end`. Bold
// texts, which are titles, get the greatest letters up to `size` with which their lines fit.
FittedText fitted(const std::string& text, double size, double pixels, bool bold = false, const std::string& end = "");

enum class Marker { disc, square, triangle, diamond, down_triangle, plus, cross, ring };
Marker status_marker(Status status);

// A convex polygon, a line through points, or a disc about one.
struct Mark {
  enum class Kind { polygon, line, disc } kind;
  std::vector<Point> points;
  Colour colour;
  double opacity = 1;
  double width = 0;             // of the line; radius of the disc
  std::vector<double> dash = {};  // lengths of stroke and gap by turns; empty: solid
  bool closed = false;          // the line returns to its first point
};

struct PlacedText {
  Point at;
  std::string text;
  TextStyle style;
};

class Canvas {
public:
  // Where (0, 0) of what follows is.
  void origin(Point origin) { origin_ = origin; }
  // What lies outside the box is cut off from here on, but for texts.
  void clip(const Box& box) { clip_ = box, clipped_ = true; }
  void no_clip() { clipped_ = false; }

  void convex(std::span<const Point> corners, Colour colour, double opacity = 1);
  void box(const Box& box, Colour colour, double opacity = 1);
  void outline(const Box& box, double width, Colour colour);
  void line(Point from, Point to, double width, Colour colour, double opacity = 1);
  // dash: lengths of stroke and gap by turns; empty: solid.
  void polyline(std::span<const Point> points, double width, Colour colour,
                std::span<const double> dash = {}, bool closed = false);
  void disc(Point centre, double radius, Colour colour);
  // size: the diameter. Rimmed in white so that it stands off its ground.
  void marker(Marker kind, Point centre, double size, Colour colour);
  // The same, pale and crossed out.
  void crossed_marker(Marker kind, Point centre, double size, Colour colour);
  // rim: pixels of white around it.
  void arrow(Point tail, Point head, double width, double head_length, Colour colour, double rim = 0);
  void text(Point at, const std::string& text, const TextStyle& style);
  // From the place of the first line on, the others below it; of an upright text, to the right.
  void text(Point first, const FittedText& lines, TextStyle style);

  // Says what has been drawn, and where, in the coordinates of its axes.
  void tell(DataMark mark) { told_.push_back(std::move(mark)); }

  const std::vector<DataMark>& told() const { return told_; }
  const std::vector<Mark>& marks() const { return marks_; }
  const std::vector<PlacedText>& texts() const { return texts_; }

private:
  void add(Mark mark) { marks_.push_back(std::move(mark)); }

  Point origin_;
  bool clipped_ = false;
  Box clip_;
  std::vector<Mark> marks_;
  std::vector<PlacedText> texts_;
  std::vector<DataMark> told_;
};

}  // namespace dotyk::figure

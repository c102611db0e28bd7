// Pictures read back, for the tests of figures.
#pragma once

#include <string>
#include <vector>

#include "../support/file.hpp"
#include "figure/door/picture.hpp"

struct Pixels {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;  // highest row first

  // x to the right, y downwards; white outside.
  dotyk::figure::Colour at(int x, int y) const;
  int count(dotyk::figure::Colour colour, int tolerance = 3) const;
};

// Throws where the file is no complete PNG.
Pixels read_png(const std::string& file);

// How two pictures of one size differ: the greatest difference of a mean colour of kWindow x kWindow pixels, in levels of 255, and the
// upper left pixel of these. Single pixels count little, since rasterisers disagree about those on edges: of Mesa's two, one differs from
// the other by up to 85 levels in a pixel of a chart, and by up to 11 in these means. Means up to kSame are the same picture.
struct Difference {
  static constexpr int kWindow = 8;
  static constexpr double kSame = 12;
  double levels = 0;
  int x = 0, y = 0;
};
Difference greatest_difference(const Pixels& a, const Pixels& b);

using dotyk::test::bytes_of;
bool exists(const std::string& file);

// The message of what f throws, "" if it does not.
template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool near(dotyk::figure::Colour a, dotyk::figure::Colour b, int tolerance = 40);

// The lines that enclose a plot, in pixels.
struct Frame {
  int left, right, top, bottom;
};

// Is the colour within a few pixels of the place that x and y, shares of the
// frame counted from its lower left, mean?
bool drawn_at(const Pixels& picture, const Frame& frame, double x, double y, dotyk::figure::Colour colour);

// The corners and the middles of the sides are white.
bool white_rim(const Pixels& picture);

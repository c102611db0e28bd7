// The region of a scene in the plane that a figure shows, where it does not
// show all of it: in the user's coordinates of the deformed picture.
#pragma once

#include <array>
#include <vector>

#include "figure/canvas/plane.hpp"
#include "figure/door/picture.hpp"

namespace dotyk::figure {

// As ScenePicture::window has it.
using Window = std::array<double, 4>;
inline Box box_of(const Window& window) { return {window[0], window[1], window[2], window[3]}; }

// The cells of a body, displaced by `factor`, whose boxes meet the window.
std::vector<int> cells_near(const BodyPicture& body, double factor, const Box& window);

// What the window shows of the bodies. Values are interpolated to its border,
// so that they are known where it lies within one cell.
struct Seen {
  bool body = false;                          // some area of some body
  double least = 1e300, greatest = -1e300;    // of the finite values; least > greatest: there are none
  void add(double value) {
    if (std::isfinite(value)) least = std::min(least, value), greatest = std::max(greatest, value);
  }
};
Seen seen(const ScenePicture& picture, const Box& window);

}  // namespace dotyk::figure

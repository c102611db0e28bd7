// The elements of supports: springs, stops, rubbing pads. One drawing for
// those below a beam, which run down, and for those about a rotation, which
// run along an arc.
#pragma once

#include "figure/canvas/canvas.hpp"
#include "figure/page/page_picture.hpp"

namespace dotyk::figure {

// Where an element runs: s pixels from where its moving end is at rest, towards
// the ground; t pixels across.
class Track {
public:
  static Track down(Point rest) { return {rest, 0, 0}; }
  // Begins above the centre and turns to the left (sign 1) or right (-1).
  static Track arc(Point centre, double radius, double sign) { return {centre, radius, sign}; }
  Point operator()(double s, double t) const;
  bool straight() const { return radius_ == 0; }

private:
  Track(Point origin, double radius, double sign) : origin_(origin), radius_(radius), sign_(sign) {}
  Point origin_;
  double radius_, sign_;
};

struct ElementPlace {
  Track track;
  double moved;   // s of what the element holds
  double slip;    // s by which a capped spring's rod has slipped
  double length;  // s of the ground
  double em;
};

void draw_element(Canvas& canvas, const SupportElement& element, const ElementPlace& place);

constexpr Colour ground_ink{70, 70, 70};

// A line of ground across, hatched beyond.
void draw_ground(Canvas& canvas, const Track& track, double s, double half, double em);

constexpr double reach = 0.85;  // of elements and ground across and beyond, in em: what room they need

}  // namespace dotyk::figure

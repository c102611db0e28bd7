// The boundary of a plate as its pictures draw it.
#pragma once

#include <optional>
#include <vector>

#include "figure/canvas/geometry.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

struct EdgePoint {
  Vec3 position = {0, 0, 0};  // z = 0
  Vec3 normal = {0, 0, 0};    // outward
  double deflection = 0, reaction = 0;
  std::optional<Status> status;
  bool extrapolated = false;
};

// Pieces that follow each other without a corner and rest on the same.
struct EdgeRun {
  PlateSupport support = PlateSupport::free;
  bool clamped = false;
  std::vector<EdgePoint> points;
};

// Pieces meet under a corner where they turn by more than 35 degrees;
// otherwise normals at their joint are the mean of both.
std::vector<EdgeRun> edge_runs(const PlatePicture& plate);

// Outwards at a point of the boundary: the mean of the runs that pass or end
// there; 0 within the plate.
Vec3 outwards_at(const std::vector<EdgeRun>& runs, double x, double y);

}  // namespace dotyk::figure

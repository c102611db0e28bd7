#include "scene/result/locate.hpp"

#include "elasticity/interpolation.hpp"

namespace dotyk::scene {

std::optional<Place> Locator::find(const mesh::Point& x) const {
  for (const int cell : grid_.near(x)) {
    Place place{cell, {}};
    if (elasticity::shape_at(mesh_, cell, x, 1e-6, place.shape)) return place;
  }
  return std::nullopt;
}

}  // namespace dotyk::scene

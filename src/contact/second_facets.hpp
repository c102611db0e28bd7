#pragma once

#include <algorithm>
#include <cmath>

#include "contact/matching.hpp"
#include "contact/projection.hpp"

namespace dotyk::contact {

/// The second part's facets, with what is needed to find those a view along a normal may see.
class SecondFacets {
 public:
  explicit SecondFacets(const Face& face) {
    const int corners = face.mesh.topology().facet_corners;
    for (const mesh::Facet f : face.facets) {
      One one{face.mesh.facet_centre(f), mesh::unit(face.mesh.facet_area_vector(f)), 0};
      for (int a = 0; a < corners; ++a)
        one.radius = std::max(one.radius, mesh::length(mesh::minus(face.mesh.point(face.mesh.facet_node(f, a)), one.centre)));
      all_.push_back(one);
    }
  }

  /// visit(facet, its width) of those that look against the view's normal (by more than 60 degrees from beside) and whose
  /// shadow may come within `radius` of a place.
  template <class Visit>
  void for_each_near(const View& view, const Flat& place, double radius, Visit&& visit) const {
    for (std::size_t f = 0; f < all_.size(); ++f) {
      const One& one = all_[f];
      if (mesh::dot(one.normal, view.normal) > kOpposed) continue;
      const Flat at = view.flat(one.centre);
      if (std::hypot(at[0] - place[0], at[1] - place[1]) <= (1 + 1e-6) * (radius + one.radius)) visit(static_cast<int>(f), 2 * one.radius);
    }
  }

 private:
  static constexpr double kOpposed = -0.5;
  struct One {
    mesh::Point centre, normal;
    double radius;
  };
  std::vector<One> all_;
};

}  // namespace dotyk::contact

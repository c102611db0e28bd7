#pragma once

#include <algorithm>
#include <cmath>

#include "contact/box_tree.hpp"
#include "contact/matching.hpp"
#include "contact/projection.hpp"

namespace dotyk::contact {

/// The boxes around a part's facets by their corners, each grown by `more` of its facet's width: 1e-6 is rounding.
inline std::vector<Box> boxes(const Face& face, double more) {
  std::vector<Box> all(face.facets.size());
  for (std::size_t f = 0; f < all.size(); ++f) {
    for (int a = 0; a < face.mesh.topology().facet_corners; ++a) all[f].add(face.mesh.point(face.mesh.facet_node(face.facets[f], a)));
    all[f].grow(more * mesh::length(mesh::minus(all[f].high, all[f].low)));
  }
  return all;
}

/// The second part's facets, with what is needed to find those a view along a normal may see.
class SecondFacets {
 public:
  explicit SecondFacets(const Face& face) : tree_(boxes(face, 1e-6)) {
    const int corners = face.mesh.topology().facet_corners;
    for (const mesh::Facet f : face.facets) {
      One one{face.mesh.facet_centre(f), mesh::unit(face.mesh.facet_area_vector(f)), 0};
      for (int a = 0; a < corners; ++a)
        one.radius = std::max(one.radius, mesh::length(mesh::minus(face.mesh.point(face.mesh.facet_node(f, a)), one.centre)));
      all_.push_back(one);
    }
  }

  /// visit(facet, its width) of those that look against the view's normal (by more than 60 degrees from beside) and whose
  /// shadow may come within `radius` of the view's origin, by their numbers.
  template <class Visit>
  void for_each_near(const View& view, double radius, Visit&& visit) const {
    const Tube tube(view.origin, view.axis, radius);
    for (const int f : tree_.find([&](const Box& box) { return tube.meets(box); }))
      if (mesh::dot(all_[f].normal, view.normal) <= kOpposed) visit(f, 2 * all_[f].radius);
  }

 private:
  static constexpr double kOpposed = -0.5;
  struct One {
    mesh::Point centre, normal;
    double radius;
  };
  BoxTree tree_;
  std::vector<One> all_;
};

}  // namespace dotyk::contact

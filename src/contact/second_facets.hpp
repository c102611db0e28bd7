#pragma once

#include <algorithm>
#include <cmath>

#include "contact/matching.hpp"
#include "contact/projection.hpp"
#include "mesh/box_tree.hpp"

namespace dotyk::contact {

using mesh::Box, mesh::BoxTree;

/// All places within `radius` of a line.
class Tube {
 public:
  /// `axes`: unit, perpendicular to the line and to each other; in the plane the second is 0.
  Tube(const mesh::Point& on_line, const std::array<mesh::Point, 2>& axes, double radius) : on_line_(on_line), axes_(axes), radius_(radius) {}
  /// False only where the tube and the box have no point in common (they are apart along one of the axes).
  bool meets(const Box& box) const {
    for (const mesh::Point& axis : axes_) {
      double middle = 0, half = 0;
      for (int i = 0; i < 3; ++i) {
        middle += axis[i] * ((box.low[i] + box.high[i]) / 2 - on_line_[i]);
        half += std::abs(axis[i]) * (box.high[i] - box.low[i]) / 2;
      }
      if (std::abs(middle) > (1 + 1e-6) * (half + radius_)) return false;
    }
    return true;
  }

 private:
  mesh::Point on_line_;
  std::array<mesh::Point, 2> axes_;
  double radius_;
};

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

#pragma once

#include <Eigen/Dense>
#include <map>

#include "scene/scene.hpp"

namespace dotyk::scene {

/// What supports leave free of the jump u₁ − u₂ at the rows of a contact: the sum V of the spaces in which the row's own nodes and the
/// partner facing them (see facing(); none of a rigid shape) are not held by fix, slide or displace, oblique slides included.
class FreeJumps {
 public:
  /// Not kept: `bodies` as they are solved, `numbering` of each.
  FreeJumps(const Scene& scene, const std::vector<Body>& bodies, const std::vector<elasticity::Numbering>& numbering, const Contact& contact);
  /// The orthogonal projection onto V, 3 × 3.
  Eigen::Matrix3d at(const contact::ContactRow& row) const;

 private:
  using Slides = std::map<int, std::vector<mesh::Point>>;  ///< node → normals
  Eigen::Matrix3d of_node(const elasticity::Numbering& numbering, const Slides& slides, int node) const;

  const Contact& contact_;
  const elasticity::Numbering *first_, *second_;  ///< second: null of a rigid shape
  Slides first_slides_, second_slides_;
  int dim_;
};

/// Is a projection of a unit vector no more than rounding?
inline constexpr double kHeld = 1e-9;

/// Unit tangents along which the jump is free: those of V that are perpendicular to the normal's projection n′ on V, by which rows of a
/// node never depend on each other. All of them where V is everything.
std::vector<mesh::Point> free_tangents(const Eigen::Matrix3d& V, const mesh::Point& normal, int dimension);
/// d/dt of one of them, where the normal turns with dn and V stays.
mesh::Point free_tangent_derivative(const Eigen::Matrix3d& V, const mesh::Point& normal, const mesh::Point& dn, const mesh::Point& tangent, int dimension);

/// The contact with the normals that supports say. Where the normal is uncertain, at an end of a curved part whose facets are chords, and
/// V lies within ContactRow::turn of it, as on a plane of symmetry, the normal is n′/|n′|; the gap at rest grows to gap/|n′|, so that
/// in V the condition stays what it was. The same object where no row changes.
std::shared_ptr<const Contact> with_held_normals(const std::shared_ptr<const Contact>& contact, const FreeJumps& jumps);
/// The derivative of such a row, by that of the row as the contact has it.
void hold_normal(const Eigen::Matrix3d& V, const contact::ContactRow& row, mesh::Point& dnormal, double& dgap);

}  // namespace dotyk::scene

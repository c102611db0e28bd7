#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>

#include "scene/statement/scene.hpp"

namespace dotyk::scene {

/// What supports leave free of the jump u₁ − u₂ at the rows of a contact: the sum V of the spaces in which the row's nodes, own and
/// partners, are not held by fix, slide or displace, oblique slides included, or by laws that prescribe a displacement, whatever its value;
/// of order 2 such laws are about means, and hold no node.
/// On a plane of symmetry V is that plane, if the row's node and one of its partners lie in the plane, and all nodes of the row that lie in it
/// stay in it. Other nodes of the row may lie off the plane.
class FreeJumps {
 public:
  /// Not kept: `bodies` as they are solved, `numbering` of each.
  FreeJumps(const Scene& scene, const std::vector<Body>& bodies, const std::vector<elasticity::Numbering>& numbering, const Contact& contact);
  /// The orthogonal projection onto V, 3 × 3.
  Eigen::Matrix3d at(const contact::ContactRow& row) const;
  /// The directions in which a tie needs rows: orthonormal, spanning V. With a single partner and V along the axes, all axes: a row without unknowns
  /// then compares what both sides prescribe.
  std::vector<mesh::Point> at(const contact::Tie& tie) const;
  /// How far apart supports move the two sides of a tie, perpendicular to V; 0 where they agree, or where no partner is held there.
  double torn(const contact::Tie& tie) const;
  /// The jump along the row's normal, Σ weight u_own − Σ weight u_partner, as supports say it; none where a node is free to move along it.
  std::optional<double> given(const contact::ContactRow& row) const;

 private:
  /// direction·u = value.
  struct Condition {
    mesh::Point direction;  ///< unit
    double value;
  };
  struct Side {
    const elasticity::Numbering* numbering;
    std::map<int, std::vector<Condition>> conditions;  ///< of nodes, but for those of single components
  };
  struct Node {
    Eigen::Matrix3d free;   ///< projection onto what moves
    Eigen::Vector3d given;  ///< displacement across it
  };
  static Side side_of(const Body& body, const elasticity::Numbering& numbering);
  Node of_node(const Side& side, int node) const;
  /// Do those of the nodes that lie in the plane V through a point stay in it?
  bool stay(const Side& side, const mesh::Mesh& mesh, const std::vector<contact::NodeWeight>& nodes, const mesh::Point& in, const Eigen::Matrix3d& V) const;
  /// The plane or line in which the node and one of its partners lie, and which supports let none of `own` and `partners` leave that lie in it.
  /// With a normal, planes perpendicular to it are not considered.
  std::optional<Eigen::Matrix3d> plane_of_symmetry(int node, const std::vector<contact::NodeWeight>& own, const std::vector<contact::NodeWeight>& partners,
                                                   const mesh::Point* normal) const;

  const Contact& contact_;
  Side first_, second_;  ///< second: of a rigid shape without numbering
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

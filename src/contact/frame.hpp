#pragma once

#include <Eigen/Core>
#include <unordered_map>

#include "contact/matching.hpp"

namespace dotyk::contact {

/// The normal of a row between two parts: one for both, whichever is named first.
///
/// The linear theory of bodies that touch without conforming acts in their common tangent plane (Johnson, Contact Mechanics, section 4.2),
/// from which the normals n₁ and n₂ of points across from each other lean away, each by its part's curvature times the distance
/// from where the parts touch. Along n₁ alone an approach δ would count as a slip of δ times that slope. With N = unit(n₁ − n₂),
/// half the difference d = n₁/(n₁·N) − N, which lies across N, and the curvatures |K₁|, |K₂| of the parts (without sign):
///   n = unit(N + M d),   M = (|K₂| − |K₁|)(|K₁| + |K₂|)⁻¹   in the plane across N.
/// Slopes K₁x and K₂x of opposite signs then cancel, crossed cylinders included: |K₂|(|K₁| + |K₂|)⁻¹|K₁| is symmetric in the parts. A flat
/// part's normal decides; parts that conform have the mean, or that of the flatter one. Exchanging the parts turns n round.
/// Curvatures below kFlat over the parts' extent count as 0, so that a flat part's normals are the same at all nodes: else motions along it
/// would be held by what rounding leaves. Where both are 0, M = 0.
/// M is no continuous function of the curvatures at 0. So it is made when the contact is, like pairs of nodes, and stays when nodes move:
/// rows then depend smoothly on the nodes. Of flat parts it is made when one of them moves, see mix_of_moving(). It differs from M made anew
/// where the ratio of two curvatures changes: normals then differ by |ΔM d|. No singular value of M is greater than 1: directions of curvature
/// that differ by a small angle φ would give 1/φ, for a point where normals agree that lies far off.
///
/// Against a rigid ball likewise, see rigid.hpp: n₂ and K₂ are then the shape's own.
struct Frame {
  mesh::Point normal{};             ///< unit, out of the first part
  std::array<mesh::Point, 3> mix{};  ///< M
  double turn = 0;                  ///< angle by which facets turn about the node: what the normals are uncertain by
};

inline constexpr double kFlat = 1e-6;

/// M of rows that have n₁, or −n₂, exactly.
inline constexpr std::array<mesh::Point, 3> kFirstDecides{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, kSecondDecides{{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

/// n and M by the normals and |K| of what touches; `inward`: −n₂, not opposed to n₁. `flat`: curvatures below it count as 0. `turn` is left 0.
Frame frame_between(const mesh::Point& n1, const Eigen::Matrix3d& K1, const mesh::Point& inward, const Eigen::Matrix3d& K2, double flat,
                    int dimension);

/// The sides of a part at its nodes that have one only. At an edge or corner the part has no normal of its own.
std::unordered_map<int, NodeSide> smooth_sides(const Face& face);

/// The partner's side; null at an edge, and where it does not face n₁.
const NodeSide* side_across(const mesh::Point& n1, int partner, const std::unordered_map<int, NodeSide>& second);
/// −n₂: the mean of the partners' inward normals, unit. Partners without side_across() go along with n₁.
mesh::Point inward_across(const mesh::Point& n1, const std::vector<NodeWeight>& partners, const std::unordered_map<int, NodeSide>& second);

/// n by n₁, −n₂ and M. Normals opposed but for rounding: n₁ as it is.
mesh::Point mixed_normal(const mesh::Point& n1, const mesh::Point& inward, const std::array<mesh::Point, 3>& mix);
/// M of a row, of whose parts one may rest while the other's nodes move. Flat parts have M = 0, and n₁ = −n₂ there; of these the one that rests
/// stays flat, and decides from then on.
std::array<mesh::Point, 3> mix_of_moving(const ContactRow& row, bool first_rests, bool second_rests);
/// d/dt of it, where n₁ and −n₂ turn with d1 and d2; M does not change.
mesh::Point mixed_normal_derivative(const mesh::Point& n1, const mesh::Point& d1, const mesh::Point& inward, const mesh::Point& d2,
                                    const std::array<mesh::Point, 3>& mix);

/// d/dt of v/|v|.
mesh::Point unit_derivative(const mesh::Point& v, const mesh::Point& dv);

/// |K| of a part at its facets: normals of the facets that share a node with one, but for those across a corner (kCornerAngle), against
/// the places where they are, least squares.
class Curvatures {
 public:
  explicit Curvatures(const Face& face);
  /// Mean over the side's facets; a 3 × 3 matrix whose kernel has the normal.
  Eigen::Matrix3d at(const NodeSide& side) const;
  double width(const NodeSide& side) const;  ///< of its widest facet
  double greatest(int node) const { return greatest_.at(node); }  ///< of the facets at a node, Frobenius' norm, 1/length

 private:
  std::vector<Eigen::Matrix3d> of_facet_;
  std::vector<double> width_;
  std::unordered_map<int, double> greatest_;
};

/// Makes frames between two parts.
class Frames {
 public:
  Frames(const Face& first, const Face& second);
  Frame of(const NodeSide& side, const std::vector<NodeWeight>& partners) const;

  const Face &first, &second;
  const Curvatures here, across;  ///< of the first, of the second

 private:
  std::unordered_map<int, NodeSide> second_sides_;
  double flat_;
};

}  // namespace dotyk::contact

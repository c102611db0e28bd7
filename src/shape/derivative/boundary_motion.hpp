#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "algebra/types.hpp"
#include "scene/result/solution.hpp"
#include "scene/statement/body.hpp"

namespace dotyk::shape {

/// How B-splines move a part: control points, and the direction in which they go.
struct ControlPoints {
  int count[2] = {6, 6};  ///< in space along the longest and second longest extent of the part; in the plane the first alone
  int degree = 3;
  /// Of every control point, any length; none: along the outward normal of the first design, the mean of the adjoining
  /// facets' by their size, of length 1.
  std::optional<mesh::Point> direction = {};
};

/// |b − a| of points in the plane.
inline double plane_distance(const double* a, const double* b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The nodes of a plane part one after the other, body on the left, and where they lie along it.
struct Chain {
  std::vector<int> nodes;       ///< of a closed one each once, from the part's first facet on
  std::vector<double> length;   ///< from the first node to each, along the part
  double total = 0;             ///< to the end; of a closed one back to the first node
  bool closed = false;
};

/// Throws InputError, naming the part, where its body is not plane or its facets are not one chain.
Chain chain_of(const scene::Part& part);

/// Velocities of a part's nodes, one set a design variable i: V_i(node) = weight(node, i) direction(node).
struct BoundaryMotion {
  scene::Part part;
  std::vector<int> nodes;               ///< ascending
  algebra::DenseMatrix weight;          ///< nodes × variables
  std::vector<mesh::Point> direction;   ///< a node each
  int variables() const { return static_cast<int>(weight.cols()); }
  mesh::Point velocity(std::size_t node, int variable) const;
};

/// Throws InputError for a body of P2 or Q2, whose derivatives are not there.
void require_first_order(const scene::Body& body);

/// V_i = N_i(t) × direction. In the plane t is the length along the part in shares of the whole, with the body on the left
/// (a bottom from left to right, a top from right to left); the part must be one chain; B-splines are open on an
/// open one, periodic on a closed one. In space t and s run along the two coordinate axes in which the part extends
/// farthest, from least to greatest coordinate, N_i(t, s) = N_j(t) N_k(s) with i = j + count[0] k.
///
/// Throws InputError for more than 4096 control points, those that move no node, a part that is no chain, B-splines that do not exist (see BSplines), a direction
/// that is zero or not finite, and normals of a node that cancel.
BoundaryMotion bspline_motion(const scene::Part& part, const ControlPoints& points);

/// Other variables β of which the first ones are α = T β: velocities Σ_i T_ij V_i. `T`: variables × new variables.
BoundaryMotion combined(BoundaryMotion motion, const algebra::DenseMatrix& T);

/// How the nodes of a scene's bodies move: body → node × dimension, length per unit of the design variable; empty: the
/// body rests.
using Velocities = std::vector<std::vector<double>>;

/// What the rows of B give to the derivative of a state when nodes move. Contacts keep their pairs of nodes, what was
/// added to their gaps and friction's bounds per length or area; glued nodes keep their axes.
struct RowChanges {
  algebra::Vector c;      ///< c' − B'u, one a row
  std::vector<std::vector<double>> force;  ///< B'ᵀλ: body → node × dimension, prescribed components included
  algebra::Vector bound;  ///< of each point of given friction, at the first of its rows; 0 on all others
};

/// Throws InputError where a part that moves is in contact by p1_p0 multipliers, whose rows' derivatives are not known,
/// or before a RigidGap.
RowChanges row_changes(const scene::Solution& solution, const Velocities& velocities);

/// d/dt of the weights of a contact's rows (index in the scene): length or area, so that with a pressure p = λ/weight
/// p' = (λ' − p weight')/weight. Against a rigid shape all facets of the part count, else those of the common surface.
std::vector<double> weight_changes(const scene::Solution& solution, int contact, const Velocities& velocities);

}  // namespace dotyk::shape

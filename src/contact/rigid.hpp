#pragma once

#include <variant>
#include <vector>

#include "contact/contact_row.hpp"
#include "elasticity/load.hpp"

namespace dotyk::contact {

/// A rigid obstacle given by its gap: u·normal ≤ gap(x) at every contact node. A negative gap
/// presses in by that much. The gap is evaluated when the rows are made.
struct RigidGap {
  mesh::Point normal;  ///< unit
  elasticity::ScalarField gap;
};

/// A rigid half-space; `normal` points out of it, towards the body.
struct RigidPlane {
  mesh::Point point;
  mesh::Point normal;  ///< unit
};

/// A rigid disc (2-D) or ball; the body is outside.
struct RigidBall {
  mesh::Point center;
  double radius;
};

using RigidShape = std::variant<RigidGap, RigidPlane, RigidBall>;

/// "rigid gap", "rigid plane", "rigid ball".
const char* name(const RigidShape& shape);

/// One row a corner of the part's facets. A plane and a gap say the normal. Against a ball it is that of frame.hpp: n₁ and |K₁| are the
/// part's, −n₂ points to the centre, and |K₂| is 1/distance from the centre, that of the sphere about it through the node. On a flat part rows
/// so have the part's normal and the gap that a RigidGap of the same ball has. Where the part has no normal of its own (edges), or one more
/// than 60° off the line to the centre, rows have that line. The gap is measured along the normal, with nodes at rest, see ball_gap().
/// `added` (may be empty) is added to it.
/// Throws InputError for a gap that is not finite, and for a plane or ball that overlaps the part
/// at rest by more than rounding, unless `interference` says that this is meant; and for a shape that lies behind the part: a plane or
/// a ball from which the part faces away where it is nearest, a gap whose normal points into the body everywhere.
std::vector<ContactRow> against(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                const RigidShape& shape, const elasticity::ScalarField& added,
                                bool interference);

/// The rows that against() made of a plane or a ball where the part's nodes have moved since: what was added to the gaps stays, as does M
/// of frame.hpp, the rest is made anew. Throws as against().
std::vector<ContactRow> moved_rows(const std::vector<ContactRow>& rows, const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets,
                                   const RigidShape& shape, bool interference);

/// How far a node at x lies from the ball along the unit n. With w = centre − x, c = w·n and ρ = |w − c n|:
///   gap = (|w|² − R²)/(c + s),   s = √(R² − ρ²) up to ρ = 0.8 R: there the line along n meets the ball at x + gap n.
/// Further out s decays like exp(−ρ²/(0.72 R²)), with s and ds/dρ as they are at 0.8 R: the line may miss the ball there, but the gap stays
/// smooth, and has the sign of |w| − R. Where the ball lies behind (c ≤ 0) it is |w| − R, as for n along w.
double ball_gap(const RigidBall& ball, const mesh::Point& x, const mesh::Point& n);
/// d/dt of it, where x moves with v, and n turns with dn.
double ball_gap_derivative(const RigidBall& ball, const mesh::Point& x, const mesh::Point& n, const mesh::Point& v, const mesh::Point& dn);

}  // namespace dotyk::contact

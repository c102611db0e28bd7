#pragma once

#include "contact/rigid.hpp"

namespace dotyk::contact {

/// How far a node at x lies from the ball along the unit n. With w = centre − x, c = w·n and ρ = |w − c n|:
///   gap = (|w|² − R²)/(c + s),   s = √(R² − ρ²) up to ρ = 0.8 R: there the line along n meets the ball at x + gap n.
/// Further out s decays like exp(−ρ²/(0.72 R²)), with s and ds/dρ as they are at 0.8 R: the line may miss the ball there, but the gap stays
/// smooth, and has the sign of |w| − R. Where the ball lies behind (c ≤ 0) it is |w| − R, as for n along w.
double ball_gap(const RigidBall& ball, const mesh::Point& x, const mesh::Point& n);
/// d/dt of it, where x moves with v, and n turns with dn.
double ball_gap_derivative(const RigidBall& ball, const mesh::Point& x, const mesh::Point& n, const mesh::Point& v, const mesh::Point& dn);

}  // namespace dotyk::contact

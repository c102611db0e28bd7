#pragma once

#include <cmath>
#include <optional>

#include "base/monitor.hpp"
#include "contact/matching.hpp"

namespace dotyk::contact {

/// What lies across from a node side of the first part.
struct Across {
  std::vector<NodeWeight> partners;  ///< weights 1 in sum; empty: nothing
  double weight = 0;              ///< length or area that the side stands for
  double widest = 0;              ///< of the facets met, and its own
  double least = -INFINITY;       ///< of mortar: least gap where the integrals look. A dual hat is negative in places: a mean of gaps may be less
  bool folded = false;            ///< the second part lies above itself there; the sheet that is nearest counts
  std::vector<NodeWeight> own{};  ///< of mortar, where it is not the node alone: the side's own mean over what is covered, `node` first
};

/// Node to segment: the foot of each node on the second part along the node's normal, the nearest one of facets whose normal
/// is opposed; weights are the facet's hats there. The forces λ_k of a uniform pressure, p∫φ_k, then meet the second part
/// as Σ λ_k φ_j(foot), which is not p∫φ_j unless nodes match: no uniform stress state is a solution, however fine the meshes.
std::vector<Across> node_to_segment(const Face& first, const Face& second, const std::vector<NodeSide>& sides);

/// Mortar with dual multipliers (Wohlmuth 2000; Popp, Gee and Wall 2009; in space Puso and Laursen 2004, Popp et al. 2010).
/// The contact pressure is p = Σ p_k ψ_k, where on each facet of the first part ψ_k is the linear (bilinear) function with
///   ∫ψ_k φ_l = δ_kl ∫φ_k     (ψ = D G⁻¹ φ, G_kl = ∫φ_kφ_l, D = diag ∫φ_k;  Σψ_k = 1),
/// and non-penetration is asked for in the mean: ∫ψ_k (u₁ − u₂∘P)·n_k ≤ ∫ψ_k gap. Because ψ is dual to φ, the first part gives
/// the row one node alone,
///   n_k·(u₁_k − Σ_j M_kj/D_k u₂_j) ≤ n_k·(Σ_j M_kj/D_k x₂_j − x₁_k),   M_kj = ∫ψ_k φ_j∘P,  D_k = ∫φ_k = Σ_j M_kj,
/// and the multiplier λ_k = p_k D_k is that node's force. P goes along the facet's normal: facets of both parts are projected
/// onto the plane of the first one's and cut (in the plane intervals, in space convex polygons), and all integrals are
/// taken on the cut pieces by a rule exact for straight edges, triangles and parallelograms; for other quadrilaterals, whose
/// hats are rational, by one of degree 11. Forces balance whatever the rule, since both sides' integrals are the same ones.
/// A uniform pressure gives Σ_k M_kj p = p∫φ_j: the patch test is passed. Matching nodes: M_kj = δ_kj D_k, the nodal rows.
/// Of a first part of order 2, φ_k in the definition of ψ are the corners' linear hats, and all its shape functions have their moments
/// in the rows: means on both sides, see ContactRow. Curved facets are projected as if the straight ones through their corners had their nodes.
/// Where the first part's facets are covered by the second in part, φ, ψ and D are those of the covered part (Cichosz and
/// Bischoff 2011), and ψ stays dual. A node with less than a fifth of ∫φ covered has no multiplier, where enough others
/// are left to bear every force and moment. ψ is then made of the hats φ of the facet's other corners, each with an equal part of that node's φ
/// added: Σψ = 1 as before, and rows are means on both sides. What is covered in less than kSliver of a facet counts as not covered.
/// `monitor` may be null; throws Interrupted.
std::vector<Across> mortar(const Face& first, const Face& second, const std::vector<NodeSide>& sides, Monitor* monitor = nullptr);

/// Below it a cut is rounding of coordinates, relative to the facet's length or area.
inline constexpr double kSliver = 1e-10;

/// How points of the second part are found across from nodes of the first: at matching nodes; at the nodes' feet; or in the mean
/// over the multipliers' surroundings. See matching.hpp and above.
enum class Pairing { matching, node_to_segment, mortar };

struct PairedRows {
  Pairing pairing;
  std::vector<ContactRow> rows;
  bool turned = false;  ///< the rows are at nodes of `second`, their partners of `first`
};

/// The rows' chord is 0 where a node has one across from it, as matching nodes have: chords are the same there; and of order 2, whose
/// facets follow the curve.
/// Rows of contact by the pairing asked for; none asked for: at nodes where all match and facets are of one kind, else mortar. So that
/// the order of naming decides nothing, mortar's multipliers are those of the part that is coarser where the parts are nearest: on the
/// finer the pressure wavers (scripts/studies/accuracy/mortar.lua, P1: Hertz's contact 80 cells on 112, 0.9 of the error of matching nodes; the other way
/// round 1.4), and forces of friction are further off. Of two alike they are the first's; in order 2, where the choice makes some per cent
/// on coarse meshes, those of the part with the greater area. Nodes to segments are the finer part's: a coarser one's would let nodes
/// between them through. Where the second part lies above itself, the rows are the first's whatever the widths. Throws InputError
/// where nodes do not match though that was asked for, where parts do not face each other, and as matching_rows().
/// A mortar row's weight is the covered part's alone. Facets of curved parts that fit each other are chords of different
/// places: without `interference` an overlap of their height is taken as touching. `monitor` may be null; throws Interrupted.
PairedRows pair_rows(const Face& first, const Face& second, std::optional<Pairing> pairing,
                     const elasticity::ScalarField& added, bool interference, Monitor* monitor = nullptr);

struct PairedTies {
  Pairing pairing;
  std::vector<Tie> ties;
};

/// The same to tie parts together, one entry a node of the first part. Throws InputError where they lie apart by more than a tenth of a
/// facet's width and what chords of curved parts make of it.
PairedTies pair_ties(const Face& first, const Face& second, std::optional<Pairing> pairing, Monitor* monitor = nullptr);

}  // namespace dotyk::contact

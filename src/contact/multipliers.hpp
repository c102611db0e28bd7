#pragma once

#include "contact/surface.hpp"

namespace dotyk::contact {

/// What the multipliers of a contact are.
/// nodal: a normal and a tangential force at each contact node (b(μ, v) by the trapezoidal rule throughout).
/// p1_p0, TR965's own: the pressure is continuous and piecewise linear, the friction's part μ_t of its bound g
/// piecewise constant: in the plane on the dual cells between the midpoints of the edges (2.13)–(2.15), in space
/// on a coarser partition T_H of the surface (3.10)–(3.12).
enum class Multipliers { nodal, p1_p0 };

/// A number at a contact row.
struct Term {
  int row;
  double weight;
};

/// The normal multiplier of the basis function ψ: its row is ∫ψ [u_n] / ∫ψ ≤ ∫ψ gap / ∫ψ, its multiplier λ the
/// force ∫ of the pressure (λ/∫ψ) ψ.
struct NormalRow {
  std::vector<Term> jumps;   ///< [u_n] at contact rows, weighted; the weights are positive
  std::vector<Term> values;  ///< ψ at contact rows
  double measure = 0;        ///< ∫ψ, length or area
};

/// One normal row a contact row, with that node's share of the length or area: TR965 (2.15)–(2.16) in the plane.
std::vector<NormalRow> nodal_normal_rows(const std::vector<ContactRow>& rows);

/// Normal rows with the Gram matrix of the surface's facets (TR965 (3.12), (3.17), (3.19)). Hats of nodes that do
/// not move (`moves`, one a contact row) are shared out among the moving nodes of their facets, and have no row of
/// their own (empty `jumps`): with them multipliers oscillate that no displacement notices.
std::vector<NormalRow> gram_normal_rows(const Surface& surface, const std::vector<ContactRow>& rows,
                                        const std::vector<char>& moves);

/// A facet of the surface, or (plane) the half of an edge next to one of its corners.
struct CellPiece {
  int facet;
  int half;  ///< corner, -1 for all of it
};

/// A piece of the contact boundary with one friction multiplier μ: constant in the plane, a pair in space. Its row
/// is the slip's mean weighted with the bound, ∫ g [u_t] / ∫g, its multiplier the force μ∫g, its bound ∫g.
struct FrictionCell {
  std::vector<Term> jumps;  ///< [u_t] at contact rows, weighted; their weights are 1 in sum but for nodes without jump
  std::vector<Term> nodes;  ///< which share of a contact row's surroundings belongs to the cell
  double bound = 0;         ///< ∫g, a force (nodal Coulomb: the coefficient)
  double measure = 0;       ///< length or area
  std::vector<CellPiece> pieces;  ///< of p1_p0
};

/// The cells of p1_p0 for the bound g at the contact rows (g_h is its linear interpolation; at a crack's tip the
/// mean of the facet's other corners). Cells where g_h vanishes are left out.
/// In the plane a dual cell a node; the half cells of a node that does not move belong to its neighbour's, those of a node that is `bare`
/// (none given: none is) to no cell: they bear no friction. `size` joins dual cells, or in space facets, into cells of about that extent H (see partition.hpp); 0 stands for the
/// dual cells themselves, in space for kCellWidth times the widest facet.
std::vector<FrictionCell> friction_cells(const Surface& surface, const std::vector<double>& g,
                                         const std::vector<char>& moves, double size, const std::vector<char>& bare = {});

/// h in space: the side of the square that the widest facet, a quadrilateral or a triangle and its mirror image,
/// fills; in the plane the longest edge.
double facet_width(const Surface& surface);

/// The default H/h in space, by the inf-sup constants of scripts/papers/tr965/inf_sup.lua (two unit blocks, h = 1/4, 1/8, 1/16):
/// those of cells of two triangles, H = h, fall with h (0.45, 0.22, 0.10; quadrilaterals 0.46, 0.14, 0.04), single
/// triangles have a kernel; with H = 2h they settle (1.16, 0.90, 0.81; quadrilaterals 1.30, 1.15, 1.10) where the
/// dual cells of the plane are (0.83; quadrilaterals 1.10). H = 3h and 4h gain little more (1.00 and 1.21 at
/// h = 1/16) and lose friction's detail.
inline constexpr double kCellWidth = 2;

}  // namespace dotyk::contact

#pragma once

#include <array>

#include "contact/contact_row.hpp"

namespace dotyk::contact {

/// A facet of the contact boundary with the contact row at each of its corners.
struct SurfaceFacet {
  mesh::Facet facet;
  int corners;
  int row[4];  ///< -1 at the tip of a crack, where one node lies on both sides: no jump there
};

/// Γ_c: the facets of the (first) part all of whose corners have a contact row, or lie on both parts. What of
/// a part overhangs the other one is left out.
struct Surface {
  const mesh::Mesh& mesh;
  std::vector<SurfaceFacet> facets;
  int rows;  ///< how many contact rows there are; some may touch no facet
};

/// `facets` are the first part's, `second` those of a second part on the same mesh (else empty).
Surface surface(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, const std::vector<ContactRow>& rows,
                const std::vector<mesh::Facet>& second);

/// ∫ φ_a φ_b over a facet of order 1; exact for segments, triangles and parallelograms.
using Gram = std::array<std::array<double, 4>, 4>;
Gram gram(const mesh::Mesh& mesh, mesh::Facet facet);

/// ∫ φ over the surface of order 1, a contact row each: κ of TR965 (2.16); 0 where a row touches no facet.
std::vector<double> measures(const Surface& surface);

/// Which pieces of the surface hang together, one number a contact row (-1 off the surface). Rows of different
/// sides of an edge are different, so that the surface falls apart at its edges.
std::vector<int> components(const Surface& surface);

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
/// (none given: none is) to no cell: they bear no friction. `size` joins dual cells, or in space facets, into cells of about that extent H (see partition()); 0 stands for the
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

/// Rows that share a facet, by row; of one side of an edge, as theirs are.
std::vector<std::vector<int>> neighbours(const std::vector<ContactRow>& rows);

/// One flag a row: its node has rows of several sides, as the tip of a wedge (TR965 (1.23)). Their normals span the jump, so that tangential
/// rows there are combinations of the normal ones: B loses rank, and forces of contact are not unique.
std::vector<char> at_corners(const std::vector<ContactRow>& rows);

/// One flag a row, in the plane: it ends a contact line.
std::vector<char> at_ends(const std::vector<ContactRow>& rows);

/// By row, the rows whose surroundings its friction stands for: itself, and shares of those `aside` (one flag each) that are nearest to it by
/// facets of the same side. Empty for those. Rows that cannot slip (`slides` false) take nothing; where nobody takes it, a row keeps its own.
std::vector<std::vector<Term>> friction_shares(const std::vector<ContactRow>& rows, const std::vector<char>& aside, const std::vector<char>& slides);

/// A small piece of a surface, to be joined with its neighbours.
struct Piece {
  mesh::Point centre;
  mesh::Box box;  ///< around it
  int component;  ///< pieces of different components are not joined
};

/// Joins pieces into cells of extent `size` along the coordinate axes: each component is cut into
/// ⌈extent/size⌉ equal slabs across its longest extent, and these likewise, until none is longer. A piece belongs
/// to the slab its centre is in. Returns the cell of each piece, numbered from 0.
std::vector<int> partition(const std::vector<Piece>& pieces, double size);

}  // namespace dotyk::contact

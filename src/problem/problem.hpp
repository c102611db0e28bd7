#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "algebra/symmetric_matrix.hpp"
#include "base/error.hpp"
#include "base/motion.hpp"
#include "problem/friction.hpp"
#include "problem/law.hpp"
#include "problem/state.hpp"
#include "problem/subdomain.hpp"

namespace dotyk::problem {

/// Coarser meshes of a body, and their functions.
struct CoarseMeshes {
  std::vector<int> nodes = {};  ///< of each that is known, the finest first
  int dimension = 0;            ///< components of a node's displacement
  /// Of so many levels, as elasticity::coarse_functions() says.
  std::function<std::vector<algebra::CoarseFunctions>(int levels)> functions = {};
  int order = 1;  ///< of the elements of the finest mesh
  /// All rigid motions by the functions of so many coarser meshes; empty: those of Block::rigid, at the nodes of these meshes.
  std::function<algebra::DenseMatrix(int levels)> rigid = {};
};

/// What the modes of a kernel are; may be empty.
struct Motions : std::vector<Motion> {
  using std::vector<Motion>::vector;
  Motions(std::vector<Motion> motions = {}) : std::vector<Motion>(std::move(motions)) {}
  /// What so much of all of them together is, a motion again; empty: that is not known.
  std::function<Motion(const algebra::Vector& amounts)> sum = {};
};

/// One body's energy ½uᵀKu − fᵀu + offset on its own unknowns.
struct Block {
  std::string name;
  algebra::SymmetricMatrix K;   ///< positive semidefinite
  algebra::Vector f;
  double offset = 0;
  std::vector<int> node;        ///< node of each unknown, ascending: what orderings keep together
  algebra::DenseMatrix kernel;  ///< ker K: unknowns × modes, linearly independent columns
  Motions motions;              ///< what the modes are; may be empty
  int first = 0;                ///< index of its first unknown among all blocks'
  /// All rigid motions of the body on its unknowns, whatever holds it: what multigrid's coarse functions are made of. May be empty.
  std::function<algebra::DenseMatrix()> rigid = {};
  CoarseMeshes coarse = {};
  /// For messages, of a node: " at (1, 0)", and what is wrong with the cells there, else empty. May be empty.
  std::function<std::pair<std::string, std::string>(int node)> about = {};
  int hidden = 0;  ///< unknowns that only the slices of K have: no row is about them, the kernel lacks their numbers, and they are not counted by size()
  /// kernelᵀ times the load that the slices of K have, and the same without signs; empty: there is none.
  algebra::Vector sliced_resultants = {}, gross_sliced_resultants = {};
  int size() const { return static_cast<int>(f.size()); }
};

/// Consecutive rows of B under one law.
struct RowGroup {
  std::string name;  ///< "contact of 'block' top with a rigid gap": for messages
  std::shared_ptr<const Law> law;
  int first = 0;
  int count = 0;
};

/// Does the law hold every row of the group at x = 0?
bool prescribes(const RowGroup& group);

/// One row of a group: the k-th of its law, r of all rows.
struct ScalarRow {
  const Law& law;
  int k, r;
};

/// One point of friction: the k-th of its group, `first` of its rows, its normal row n or -1.
struct FrictionPoint {
  const FrictionGroup& group;
  int k, first, n;
};

/// The one statement behind every model:
///   minimise ½uᵀKu − fᵀu + Σ_r φ_r((Bu − c)_r),   K u + Bᵀλ = f,  λ_r ∈ ∂φ_r.
struct Problem {
  std::vector<Block> blocks;
  algebra::SparseRows B;  ///< rows × unknowns of all blocks
  algebra::Vector c;      ///< gaps, one a row
  std::vector<RowGroup> groups;            ///< scalar laws
  std::vector<FrictionGroup> friction;     ///< tangential rows; a row is under one law only
  /// The blocks cut into pieces, by block, where the method asked for it; empty: each block is one piece.
  std::vector<Subdomain> subdomains;
  /// Rows of one kind that follow one another along an edge, where that is known; every row is in one chain at most, but for the ends.
  std::vector<std::vector<int>> chains;
  /// The length or area κ_r that the pressure of a contact's row stands for; 0, or none given, on other rows.
  std::vector<double> measure;
  /// Where a row is, for messages: "node 12 of 'block' at (0.5, 0)". May be empty.
  std::function<std::string(int)> row_name;
  /// The load is f of the blocks, and so many times the load that was assembled with the slices of K: see SlicedMatrix::add_load(). Not 0 only where unknowns are hidden.
  double sliced_load = 0;

  int unknowns() const { return blocks.empty() ? 0 : blocks.back().first + blocks.back().size(); }
  int all_unknowns() const;  ///< hidden ones among them
  bool hides() const { return all_unknowns() > unknowns(); }
  int rows() const { return static_cast<int>(c.size()); }
  /// The index of the block that an unknown belongs to.
  std::size_t block_of(Eigen::Index unknown) const;
  /// All rows under scalar laws, and all points of friction, group by group.
  std::vector<ScalarRow> scalar_rows() const;
  std::vector<FrictionPoint> friction_points() const;
  /// The group of every row.
  std::vector<const RowGroup*> group_of_rows() const;
  /// Stiffness seen by each row, of the parts that it joins one after the other, at most: 1 / Σ_j B_rj²/K_jj, in force per displacement. Where a soft part touches
  /// a stiff one it is the soft one's; 0 where no unknown moves the row. The unit of ρ.
  algebra::Vector row_stiffness() const;
  /// B's columns of one block, in the block's own numbering.
  algebra::SparseRows rows_of(const Block& block) const;
  algebra::Vector load() const;            ///< f of all blocks, without what the slices have: see whole_load()
  bool loaded() const;                     ///< is one of its numbers not 0? Without a load nothing but rounding gives forces a scale
  /// The unknowns of B's entries, ascending, and B with these columns alone.
  struct NearRows {
    std::vector<int> unknowns;
    algebra::SparseRows B;
  };
  NearRows near_rows() const;
  std::string name_of(int row) const;      ///< by row_name, or "row 7"
};

/// Throws InputError where K resists one of the modes said to be its kernel:
/// algebra::kernel_residual() above 1e-12. `name`: whose K, in quotes; `motions`: what the modes are.
void require_kernel(const algebra::SymmetricMatrix& K, const algebra::DenseMatrix& kernel, const std::string& name,
                    const std::vector<Motion>& motions);

/// Throws InputError where stiffnesses, forces (loads, and what gaps and moves make of the stiffness) or displacements are so large or
/// small that methods on rows, which compare squares and products of them, leave the range of numbers: to inf, to nan or, with a
/// wrong solution that looks right, to 0. One linear solve needs no squares. Forces: beyond `most_force` or below its inverse.
void require_moderate(const Problem& problem, double most_force);

/// For methods on rows: squares stay within 1e±240, and leave room for sums and for what is small beside the greatest.
inline constexpr double kMostForceOnRows = 1e120;
/// For methods on subdomains, which bring loads to 1 before they square them.
inline constexpr double kMostForceOnSubdomains = 1e175;

/// The stiffness of a block cannot be factored though its kernel is held: to rounding it is singular, as that of very thin bodies is without contact.
class SingularStiffness : public InputError {
 public:
  using InputError::InputError;
};

/// Throws it: a stiffness that should be positive definite beyond its `modes` rigid motions is singular. `name`: whose, in quotes; `node`: where,
/// from 0, or -1.
[[noreturn]] void refuse_singular(const std::string& name, Eigen::Index modes, int node, const std::pair<std::string, std::string>& about = {});
[[noreturn]] void refuse_singular(const Block& block, int unknown);  ///< unknown: of the block, or -1

/// Adds a block, setting its `first`. Throws as require_kernel().
void add(Problem& problem, Block block);

/// Bu.
algebra::Vector rows_times(const Problem& problem, const Displacement& u);
/// Bu − c.
inline algebra::Vector jumps(const Problem& problem, const Displacement& u) { return rows_times(problem, u) - problem.c; }

/// Gives each block its part of a stiffness of all of them that is in slices.
void take_slices(Problem& problem, const std::shared_ptr<const algebra::SlicedMatrix>& slices);
/// That stiffness; null where not all blocks have their part of one.
const algebra::SlicedMatrix* slices(const Problem& problem);
/// Vectors that lie with the slices, or here where there are none. `watched`: unknowns, ascending.
std::shared_ptr<algebra::Vectors> vectors(const Problem& problem, const std::vector<int>& watched = {});
/// The whole load as such a vector: f of all blocks, and the load that the slices have. `where`: what vectors() gave; null: it is asked for new ones.
algebra::Field whole_load(const Problem& problem, std::shared_ptr<algebra::Vectors> where = nullptr);
/// u as such a vector: its own where it lies so already.
std::shared_ptr<const algebra::Field> field(const Problem& problem, const Displacement& u);

/// The lower triangle of the stiffness of all blocks.
algebra::SparseMatrix lower_stiffness(const Problem& problem);
/// The node of each unknown, ascending; blocks share none.
std::vector<int> nodes(const Problem& problem);
/// K u, block by block, in extended precision, rounded at the end. Forces of neighbouring cells are differences of terms that are greater by (size/cell)² in
/// a solid, and by its square in a beam or a plate.
algebra::Vector stiffness_times(const Problem& problem, const algebra::Vector& u);
/// K u as a vector that lies where u does: precisely as well, or with u.high in double precision.
algebra::Field stiffness_times(const Problem& problem, const algebra::LongField& u, bool precisely);
/// from −= K u, precisely (in extended precision) or with u.high in double precision. The vectors lie with the slices, or in this process where there are none.
void take_stiffness_times(const Problem& problem, const algebra::LongField& u, bool precisely, algebra::Field& from);

}  // namespace dotyk::problem

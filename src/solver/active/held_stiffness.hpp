#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "algebra/field.hpp"
#include "algebra/spd_solver.hpp"
#include "base/error.hpp"
#include "problem/rigid_motions.hpp"
#include "problem/row_basis.hpp"

namespace dotyk::problem {
struct Coarser;
}

namespace dotyk::solver {

/// What a linear solver is made from: the first matrix, in the basis where rows are unknowns, and the problem that it belongs to.
struct SpdSystem {
  const algebra::SparseMatrix& lower;  ///< nothing held, no springs; where there are slices, of entries near rows alone
  const algebra::Triplets& changed;    ///< other numbers that make it definite: of springs in the rows of bodies that nothing else holds
  const problem::Problem& problem;
  const problem::RowBasis& basis;
  Monitor& monitor;  ///< outlives the solver
  algebra::SymmetricMatrix* coarser;       ///< receives what problem::coarser() takes, if the solver makes it; null: there is no nested iteration
  const algebra::SlicedMatrix* slices;     ///< K; null: there are none
  const algebra::Triplets& beside_slices;  ///< entries of TᵀKT that differ from K's, where there are slices
  const std::vector<int>& near_rows;       ///< as in HeldStiffness
};
struct MakeSpdSolver {
  std::function<std::unique_ptr<algebra::SpdSolver>(const SpdSystem&)> make;
  bool takes_slices = false;  ///< else all of SpdSystem::lower is needed
  explicit operator bool() const { return bool(make); }
};

/// A linear problem of an iteration was not solved, or the library that should do it cannot be opened.
struct NotSolved : InputError {
  using InputError::InputError;
};

/// Conjugate gradients did not solve with the stiffness: too many iterations, or a matrix that is not definite.
struct SlowIterations : NotSolved {
  using NotSolved::NotSolved;
};

/// A sparse Cholesky factor.
MakeSpdSolver factor(algebra::Ordering ordering);
/// Conjugate gradients with an incomplete Cholesky factor.
MakeSpdSolver incomplete_factor();
/// What the levels of multigrid are made of: coarser meshes, where they are known, or aggregates of unknowns alone.
enum class Levels { meshes, aggregates };
/// Conjugate gradients with multigrid, which give up when their rate of convergence foretells more than `most_iterations`. Making the solver throws
/// NotSolved where its library cannot be opened.
MakeSpdSolver multigrid(Levels levels, double most_iterations = std::numeric_limits<double>::infinity());

/// A = Tᵀ(K + Σ_r s_r B_rᵀB_r)T in the basis T where rows are unknowns, with the rows and columns of held unknowns emptied but for their diagonal:
/// what active-set and barrier iterations solve with where rows act on few unknowns each. One pattern for all s and all that is held.
/// Motions that no row notices are held as well, at as many unknowns, and taken off solutions.
class HeldStiffness {
 public:
  static constexpr double kTolerance = 1e-12;
  /// `coarser`: as in SpdSystem.
  HeldStiffness(const problem::Problem& problem, const problem::RigidMotions& rigid, const MakeSpdSolver& make, Monitor& monitor,
                algebra::SymmetricMatrix* coarser = nullptr);

  const problem::RowBasis& basis() const { return basis_; }
  /// Unknowns that rows act on, those of rows, those that fixing_noticed() names, and what K couples to the latter two: ascending. T is the identity
  /// elsewhere. Vectors of them alone are called near.
  const std::vector<int>& near_rows() const { return near_; }
  int place(int unknown) const { return place_[unknown]; }            ///< among them; −1: it is none
  const algebra::SparseRows& jumps() const { return jumps_; }         ///< B of near displacements
  const algebra::SparseRows& rows() const { return near_jumps_; }     ///< B T, likewise
  const problem::RowBasis& near_basis() const { return near_basis_; } ///< basis(), likewise
  /// Zeros. Such vectors lie with the slices of K, or here where there are none; near_rows() are watched.
  algebra::Field field() const { return algebra::Field(vectors_); }
  algebra::Field field(const problem::Displacement& u) const;  ///< the same with these numbers
  algebra::Field load() const { return problem::whole_load(problem_, vectors_); }
  /// Flags so many layers of neighbours in `of` as well, and returns a lower triangle that has at least the entries of TᵀKT in rows and columns of flagged unknowns.
  algebra::SymmetricMatrix near(std::vector<char>& of, int layers) const;
  /// `spring`: s, force per displacement, rows; `held`: one flag an unknown of the basis, of those of rows and of fixing_noticed() alone; `added`: to the
  /// matrix, lower triangle, of the unknowns of rows of one point. False where the matrix is not positive definite.
  bool factor(const algebra::Vector& spring, const std::vector<char>& held, const std::vector<Eigen::Triplet<double>>& added = {});
  /// Interpolates a displacement of the next coarser mesh to this one. To be called before anything is held.
  problem::Displacement interpolated(const problem::Coarser& coarse, const problem::Displacement& u) const;
  /// What forces displace.
  struct Displaced {
    bool found = true;                ///< else u has no meaning: the solver is direct, or the forces are no numbers
    bool told = false;                ///< are `left` and `near_resistance` known? Iterative solvers tell what is left
    algebra::Field u;
    algebra::Vector near_u;           ///< u near rows
    algebra::Field left;              ///< forces that are left, zero near rows
    algebra::Vector near_resistance;  ///< TᵀKu near rows
  };
  /// u under the forces b, zero in what is held.
  algebra::Vector solve(const algebra::Vector& b) const;
  /// The same for forces Tᵀb: `near` has those near rows, `elsewhere` all others. Afterwards `elsewhere` has those of `near` as well, zero where unknowns are
  /// held. An iterative solver stops at a residual of `tolerance` times their norm, and throws SlowIterations where it cannot reach that.
  Displaced solve_in_basis(algebra::Field& elsewhere, algebra::Vector near, double tolerance = kTolerance) const;
  /// TᵀKT y at the unknowns that rows may hold; where y is zero but there, at all unknowns. Near vectors.
  algebra::Vector resistance_of_watched(const algebra::Vector& y) const;

  /// A few unknowns: where they are held, the bodies cannot move in a way that rows notice.
  const std::vector<int>& fixing_noticed() const { return fixing_noticed_; }
  /// u without the motions that no row notices: solve() gives none of them.
  algebra::Field noticed(const problem::Displacement& u) const { return unnoticed_.cols() > 0 ? field(problem::least(unnoticed_, u.here())) : field(u); }

  const algebra::SpdSolver& solver() const { return *solver_; }

 private:
  /// An entry of the lower triangle, and what it has beyond lower().
  struct Entry {
    std::ptrdiff_t place;
    int row, column;
    double by = 0;
  };

  /// The lower triangle of TᵀKT; where rows couple unknowns its pattern has places, with zeros if need be. Of slices, all entries of unknowns of rows.
  const algebra::SparseMatrix& lower() const { return lower_.lower(); }
  /// Returns SpdSystem::beside_slices.
  algebra::Triplets assemble(bool takes_slices);
  void fix_noticed(const problem::RigidMotions& rigid);
  /// assemble() for a K in slices. `room`: entries that the pattern must contain.
  algebra::Triplets assemble_near_rows(const algebra::Triplets& room);
  /// near() for a K in slices. Layers are layers of displacements, the first of which are those that the flagged unknowns move.
  algebra::StoredMatrix near_from_slices(std::vector<char>& of, int layers) const;
  void change(int row, int column, double by);
  void spring_rows(const algebra::Vector& spring);
  void watch();
  void take_near_rows();
  void empty_held(algebra::Vector& near) const;  ///< zeros there
  /// TᵀKT y from A y near rows, for a y that is zero at what is held: A has springs in addition, and lacks the rows of held unknowns.
  algebra::Vector resistance(const algebra::Vector& y, algebra::Vector Ay) const;
  /// Calls visit(unknown, force) for what makes up TᵀKT y at the unknowns that rows may hold.
  template <class Visit>
  void each_watched_force(const algebra::Vector& y, const Visit& visit) const;
  /// What differs from lower(), each place once and in their order; changed_ is empty then.
  std::vector<Entry> now();
  /// The numbers of these entries, and of those that the solver was told of and that no longer differ.
  algebra::Triplets numbers(const std::vector<Entry>& now) const;

  const problem::Problem& problem_;
  const problem::RowBasis basis_;
  const algebra::SparseMatrix unnoticed_;
  algebra::SparseRows rows_;        ///< B T
  std::vector<int> near_, place_;
  algebra::SparseRows jumps_, near_jumps_;
  problem::RowBasis near_basis_;
  std::shared_ptr<algebra::Vectors> vectors_;
  algebra::SymmetricMatrix lower_;  ///< K itself where that has the room and T is the identity
  const algebra::SlicedMatrix* slices_ = nullptr;  ///< K; null: lower() is the whole
  std::vector<int> fixing_;         ///< unknowns that hold motions which no row notices
  std::vector<int> fixing_noticed_;
  std::vector<Entry> changed_;      ///< of the next matrix, in no order
  std::vector<Entry> told_;         ///< of the solver's
  std::vector<char> held_, watched_;
  std::vector<Entry> of_watched_;   ///< entries whose row or column is of an unknown that may be held
  std::unique_ptr<algebra::SpdSolver> solver_;
};

}  // namespace dotyk::solver

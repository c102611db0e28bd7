#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "problem/condensed.hpp"
#include "problem/problem.hpp"

namespace dotyk::solver {

/// What an active-set method for programs counted.
struct WorkingSetCounts {
  int added = 0, dropped = 0;        ///< rows that entered and left the working set
  int singular = 0, survived = 0;    ///< singular KKT systems met, and those that still gave a step
  int factorisations = 0;
  int repeats = 0;                   ///< times zigzagging was noticed
};

/// How far a penalised problem's solution is from the one asked for.
struct PenaltyError {
  double factor = 0;
  double penetration = 0;  ///< greatest violation of a row, a length
  /// λᵀ(Bu − c): what the energy is too low by, up to terms of second order in 1/factor, and never more than
  /// that: J(u) + λᵀ(Bu − c) is the dual energy at λ.
  double energy = 0;
};

/// Where magnetic screws were: rows of B, and how well they hold (see Screws).
struct ScrewPlacement {
  std::vector<int> rows;
  double regularity = 1;
  double determinant = 1;
};

/// What domain decomposition worked on.
struct FetiCounts {
  int subdomains = 0;
  int factors = 0;     ///< distinct ones: equal subdomains share one
  int rows = 0;        ///< of the dual problem: interface conditions, gluing, supports
  int kernel = 0;      ///< rigid motions of all subdomains: the coarse space
  int inner = 0;       ///< steps of the inner method
  int products = 0;    ///< with F
  int loops = 0;       ///< updates of Coulomb's bounds
  double norm = 0;     ///< upper bound of ‖PFP‖, a displacement per force
  double rho = 0;      ///< last penalty, in units of `norm`
  double condition = 0;  ///< of PFP on im P, where asked for; else 0
};

struct MultigridCounts {
  int levels = 0;
  int cg = 0;      ///< conjugate gradient iterations of all linear systems
  int newton = 0;  ///< steps
};

/// How a method ended.
struct Result {
  problem::State state;
  bool converged = false;
  std::string method;
  std::string reason;  ///< one sentence: why it stopped, and up to what the solution is unique
  int iterations = 0;
  std::vector<IterationInfo> history;
  /// Rows in contact (active branch of their law) in every iteration, as it began; of methods on the
  /// condensed rows alone, each time that they changed, and at the end; of methods on programs, at the end.
  std::vector<std::vector<char>> active_sets;
  std::vector<char> slipping;  ///< rows of friction points that slip at the end; empty without friction
  std::optional<WorkingSetCounts> working_set;
  std::optional<PenaltyError> penalty;
  std::optional<FetiCounts> feti;
  std::optional<MultigridCounts> multigrid;
  int screw_moves = 0;  ///< magnetic screws moved after their multiplier came out negative
  std::vector<ScrewPlacement> screws;  ///< first and after each move; empty without screws
  problem::Clock clock;
  double factor_bytes = 0;
  /// See judge(). A relative residual beyond this is no solution; rounding leaves less.
  double noise = 1e-6;
  /// Residuals up to this are what tol left (of equilibrium, too, where bodies are held by contact alone; not with penalty or feti).
  double asked = 0;
  std::string ordering;  ///< the ordering used, "AMD", "METIS", …
};

/// What a run begins with.
struct Beginning {
  /// Rows taken as active at the start, one flag a row; empty: the method's own choice, mostly the rows whose gap is closed at rest.
  std::vector<char> start;
  /// Shared by problems that differ in f and c alone, for methods that condense; empty: condensed anew.
  std::shared_ptr<problem::Condenser> condenser = nullptr;
  /// A state of this problem to go on from. RowMethod and `pdas` on all unknowns then ignore `start`; other methods ignore this. Empty: from rest.
  std::shared_ptr<const problem::State> from = nullptr;
};

/// What every method takes.
struct Settings : Beginning {
  double tol = 1e-10;        ///< on the relative natural residual
  int max_iterations = 100;
  algebra::Ordering ordering = algebra::Ordering::automatic;
  /// Does the method begin anew, whatever `start` and `from` say?
  static constexpr bool begins_anew = false;
  /// Does the method solve problems without rows in its own way, not by solve_linear()?
  static constexpr bool takes_linear = false;
};

/// K u = f for a problem without rows: order, factor, substitute. The yardstick of every other method.
/// Throws InputError where a free block's load is not in equilibrium; where it is, gives the
/// displacement without rigid part.
Result solve_linear(const problem::Problem& problem, algebra::Ordering ordering, Monitor& monitor);

}  // namespace dotyk::solver

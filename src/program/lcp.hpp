#pragma once

#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "algebra/types.hpp"

namespace dotyk::program {

/// The linear complementarity problem: w = Mz + q ≥ 0, z ≥ 0, zᵀw = 0; M n × n, any.
struct Lcp {
  algebra::SparseMatrix M;
  algebra::Vector q;
  std::string name = {};
  int size() const { return static_cast<int>(q.size()); }
};

/// Throws InputError where sizes do not fit or a number is not finite.
void check(const Lcp& lcp);

/// max |min(ẑ_i, ŵ_i)|, ẑ = z/(1 + max|z|), ŵ = w/(|M||z| + |q|) row by row: 0 at a solution.
double residual(const Lcp& lcp, const algebra::Vector& z);

/// A set of unknowns as flags: free ones have w = 0, the others z = 0.
using FreeSet = std::vector<char>;

/// The z with w = 0 on a set and z = 0 off it; empty where M is singular on the set.
algebra::Vector on_set(const Lcp& lcp, const FreeSet& free);

/// Newton's method on min(z, w) = 0, that is the primal-dual active set: with z of a free set, the next
/// one is {i: z_i > w_i}.
struct NewtonMin {
  enum class End { solved, cycle, singular, stopped } end = End::stopped;
  algebra::Vector z;            ///< of the last set that could be solved
  int solves = 0;
  std::vector<FreeSet> cycle;   ///< the sets that repeat, in order
};
/// From a free set; ends at the first set that comes back, or where the monitor asks to stop.
NewtonMin newton_min(const Lcp& lcp, FreeSet start, Monitor& monitor, int max_solves = 1000);

/// Lemke's method (Lemke 1965; Cottle, Pang and Stone 1992, section 4.4) with covering vector 1. Of rows that block at once
/// the least is taken for q + εp, p random and ε as small as need be, so that it does not cycle. Without a solution it ends
/// on a ray, which proves that there is none where M is positive semidefinite (more generally, copositive-plus), and
/// nothing otherwise. A sparse factor of the basis is updated by product form for some pivots: a pivot costs as much as
/// two solves. Ends where the monitor asks to stop, too.
struct Lemke {
  bool solved = false, ray = false;
  algebra::Vector z;
  int pivots = 0;
};
Lemke lemke(const Lcp& lcp, Monitor& monitor, int max_pivots = 100000);

/// Solutions by trying every set, n ≤ 16: at most `most` distinct ones; `continuum` where a set with
/// singular M has a whole segment of them (two of its points are then among the solutions).
struct Enumeration {
  std::vector<algebra::Vector> solutions;
  bool continuum = false;
  bool complete = true;  ///< false where it was stopped
};
Enumeration enumerate(const Lcp& lcp, int most, Monitor& monitor);

struct LcpSettings {
  enum class Method { automatic, newton_min, lemke, enumeration } method = Method::automatic;
  FreeSet start;         ///< of newton_min; empty: no unknown is free
  bool unique = true;    ///< n ≤ 16: look whether there are further solutions
};

enum class LcpStatus { solved, several, none, stopped };
const char* text_of(LcpStatus status);

struct LcpResult {
  LcpStatus status = LcpStatus::stopped;
  std::string reason;              ///< one sentence
  std::string method;              ///< which method found z
  algebra::Vector z, w;            ///< the solution, or the best known
  algebra::Vector other;           ///< a second one, where there are several
  std::vector<FreeSet> cycle;      ///< sets among which newton_min went round
  int solves = 0, pivots = 0;
  double residual = 0, seconds = 0;
  bool counted = false;            ///< uniqueness was decided
};

/// `automatic`: newton_min; where it cycles or meets a singular matrix, lemke; where that ends on a ray and n ≤ 16,
/// enumeration decides. `several` is only said where a second solution is known.
LcpResult solve(const Lcp& lcp, const LcpSettings& settings, Monitor& monitor);

/// A text file of siconos (numerics): n, storage 0 (dense) or 1 (blocks), sizes, M, q; whatever follows is
/// comment. The numbers of M, and of each block, run down its columns, though a line looks like a row: only so
/// examples 4.4.7 of Cottle, Pang and Stone and Pang's isolated solution are what their names say, and the
/// dense and the block file of one problem agree. Throws InputError naming the file.
Lcp read_lcp(const std::string& file);

}  // namespace dotyk::program

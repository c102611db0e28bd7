// The processes that wait for rank 0's solvers, and what they do for them.
#pragma once

#include <string>

#include "multigrid/ranks.hpp"

namespace dotyk::multigrid {

enum class Task : int { make, set, solve, drop, end };

/// How rank 0 tells the other ranks what to do for one solver. The data of a task are sent after it.
class Workers {
 public:
  Workers(const Ranks& ranks, int solver) : ranks_(ranks), solver_(solver) {}
  const Ranks& ranks() const { return ranks_; }
  void tell(Task task) const;
  void made() const;  ///< the solver lives, until it tells `drop`

 private:
  Ranks ranks_;
  int solver_;  // its number
};

/// For a solver of so many unknowns: all ranks, or this one alone where shares would be too small.
Workers workers_for(double unknowns);

/// Starts so many processes less one of this program, which then are ranks 1, 2, …; before anything else that needs MPI.
/// Throws InputError where MPI cannot, or has begun without them.
void spawn_workers(int ranks, const std::string& program);
/// Rank 0 under mpirun, at once: the others wait for it.
void meet_workers();
/// How many ranks there are; 1 where MPI has not started.
int ranks_now();
/// What ranks other than 0 do: the tasks, until the last. `spawned`: by spawn_workers(), else by mpirun.
void work(bool spawned);
/// Tells them the last. Called once, by rank 0, when nothing more will be solved.
void end_workers();

}  // namespace dotyk::multigrid

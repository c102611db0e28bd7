// The processes that wait for rank 0's solvers, and what they do for them.
#pragma once

#include <mutex>
#include <string>

#include "multigrid/processes/petsc_session.hpp"
#include "multigrid/processes/ranks.hpp"
#include "multigrid/slices.hpp"

namespace dotyk::multigrid {

enum class Task : int { make, set, solve, drop, slice, refined_slice, visit, multiply, some, drop_slice, vectors, order, get, put, get_some, set_some, interpolate, drop_vectors, end };

/// How rank 0 tells the other ranks what to do for one solver, for the slices of one matrix, or for some vectors. The data of a task are sent after it.
class Workers {
 public:
  Workers(const Ranks& ranks, int number) : ranks_(ranks), number_(number) {}
  const Ranks& ranks() const { return ranks_; }
  void tell(Task task) const;
  void tell(Task task, int rank) const;  ///< the same to one rank
  Workers next() const;                  ///< the same ranks, for another solver, other slices or vectors
  int number() const { return number_; }  ///< by which the ranks know these, from 1
  /// Tells the task, sends each other rank the data that send(rank) sends, and does rank 0's part, whose result it returns. No other thread has work of
  /// the ranks meanwhile.
  template <class Send, class Own>
  auto run(Task task, const Send& send, const Own& own) const {
    const std::lock_guard lock(only_one());
    return ranks_.together([&] {
      tell(task);
      for (int r = 1; r < ranks_.count(); ++r) send(r);
      return own();
    });
  }
  void made() const;  ///< the solver, or the slices, live, until they tell `drop` or `drop_slice`; vectors are not counted, because they hold nothing of PETSc's

 private:
  Ranks ranks_;
  int number_;
};

/// Are there several ranks, and shares of so many unknowns large enough?
bool several_ranks_have_work(double unknowns);
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
void work(bool spawned, const ShareMakers& makers);
/// Tells them the last. Called once, by rank 0, when nothing more will be solved.
void end_workers();

}  // namespace dotyk::multigrid

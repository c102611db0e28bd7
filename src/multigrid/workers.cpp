#include "multigrid/workers.hpp"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>

#include "multigrid/cycle.hpp"

namespace dotyk::multigrid {

namespace {

/// All processes. The communicator is our own, so that PETSc's messages are not taken for ours.
const Ranks& world() {
  static const Ranks ranks = [] {
    start_petsc();
    MPI_Comm own = MPI_COMM_NULL;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    return Ranks(own);
  }();
  return ranks;
}

/// Solvers that live, on rank 0.
int& living() {
  static int count = 0;
  return count;
}

/// The next task and the number of its solver. MPI would keep a processor busy with waiting.
std::vector<int> next_task() {
  constexpr int kShortest = 50, kLongest = 2000;  // microseconds
  int there = 0;
  for (int wait = kShortest; MPI_Iprobe(0, MPI_ANY_TAG, world().comm(), &there, MPI_STATUS_IGNORE), !there; wait = std::min(kLongest, wait + wait / 50 + 1))
    usleep(static_cast<useconds_t>(wait));
  std::vector<int> task;
  world().receive(0, task);
  return task;
}

void solve(Cycle& cycle) {
  std::vector<double> ending, b;
  world().receive(0, ending);
  world().receive(0, b);
  world().send(0, cycle.solve(b, ending[0], ending[1], nullptr).x);
}

/// Where solvers still live, as when a script ends by os.exit, PETSc cannot be ended: MPI alone is.
void finalise(bool clean) {
  if (clean) PetscFinalize();
  else MPI_Finalize();
}

}  // namespace

Workers workers_for(double unknowns) {
  constexpr double kShare = 1000;  // unknowns
  static int solvers = 0;
  const bool all = world().count() > 1 && unknowns >= kShare * world().count();
  return {all ? world() : Ranks(MPI_COMM_SELF), ++solvers};
}

void Workers::tell(Task task) const {
  if (task == Task::make) ++living();
  if (task == Task::drop) --living();
  for (int r = 1; r < ranks_.count(); ++r) ranks_.send(r, std::vector<int>{static_cast<int>(task), solver_});
}

void work() {
  world().together([] {
    std::map<int, std::unique_ptr<Cycle>> cycles;
    for (;;) {
      const std::vector<int> order = next_task();
      const int solver = order[1];
      switch (static_cast<Task>(order[0])) {
        case Task::make: cycles[solver] = std::make_unique<Cycle>(world(), receive_piece(world(), 0)); break;
        case Task::set: cycles.at(solver)->set(receive_change(world(), 0)); break;
        case Task::solve: solve(*cycles.at(solver)); break;
        case Task::drop: cycles.erase(solver); break;
        case Task::end:
          if (!solver)
            for (auto& [number, cycle] : cycles) static_cast<void>(cycle.release());
          finalise(solver != 0);
          return;
      }
    }
  });
}

void end_workers() {
  const bool clean = living() == 0;
  for (int r = 1; r < world().count(); ++r) world().send(r, std::vector<int>{static_cast<int>(Task::end), clean});
  finalise(clean);
}

}  // namespace dotyk::multigrid

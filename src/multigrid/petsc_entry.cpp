// The doors of the library with PETSc. No exception passes them. PETSc knows no threads, so one call at a time goes through.
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>

#include "multigrid/petsc_solver.hpp"

using namespace dotyk;
using multigrid::Message, multigrid::Outcome, multigrid::PetscSolver, multigrid::Watcher;

namespace {

std::mutex& only_one() {
  static std::mutex mutex;
  return mutex;
}

template <class Work>
Outcome guarded(Work work, Message* message) {
  const std::lock_guard lock(only_one());
  try {
    return work();
  } catch (const std::exception& e) {
    std::snprintf(message->text, sizeof message->text, "%s", e.what());
  } catch (...) {
    std::snprintf(message->text, sizeof message->text, "algebraic multigrid failed for an unknown reason");
  }
  return Outcome::failed;
}

bool asked_to_stop(const Watcher& watcher) { return watcher.stop(watcher.who); }

}  // namespace

#define DOTYK_DOOR extern "C" __attribute__((visibility("default")))

DOTYK_DOOR Outcome dotyk_multigrid_make(const multigrid::Matrix* matrix, const Watcher* watcher, void** hierarchy, Message* message) {
  return guarded([&] {
    multigrid::start_petsc();
    if (asked_to_stop(*watcher)) return Outcome::stopped;
    auto solver = std::make_unique<PetscSolver>(*matrix);
    if (asked_to_stop(*watcher)) return Outcome::stopped;
    *hierarchy = solver.release();
    return Outcome::done;
  }, message);
}

DOTYK_DOOR Outcome dotyk_multigrid_set(void* solver, const algebra::SparseMatrix* lower, const std::vector<char>* held,
                                       const Watcher* watcher, Message* message) {
  return guarded([&] {
    if (asked_to_stop(*watcher)) return Outcome::stopped;
    return static_cast<PetscSolver*>(solver)->set(*lower, *held) ? Outcome::done : Outcome::not_definite;
  }, message);
}

DOTYK_DOOR Outcome dotyk_multigrid_solve(void* solver, const double* b, double tolerance, double* x, const Watcher* watcher, Message* message) {
  return guarded([&] { return static_cast<PetscSolver*>(solver)->solve(b, tolerance, x, *watcher); }, message);
}

DOTYK_DOOR void dotyk_multigrid_facts(void* solver, multigrid::Facts* facts) {
  Message message;
  guarded([&] {
    *facts = static_cast<PetscSolver*>(solver)->facts();
    return Outcome::done;
  }, &message);
}

DOTYK_DOOR void dotyk_multigrid_drop(void* solver) {
  const std::lock_guard lock(only_one());
  delete static_cast<PetscSolver*>(solver);
}

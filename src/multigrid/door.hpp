// The doors of libdotyk_multigrid_petsc.so: functions that no exception passes.
#pragma once

#include "multigrid/multigrid.hpp"

namespace dotyk::multigrid {

enum class Outcome : int { done, stopped, not_definite, failed };  // failed: the reason is in Message

struct Message {
  char text[1024] = "";
};

/// Asked in every iteration whether to stop.
struct Watcher {
  bool (*stop)(void* who) = nullptr;
  void* who = nullptr;
};

struct Facts {
  double bytes = 0;
  int iterations = 0, levels = 0;
  char version[32] = "";  // of PETSc, "3.18"
};

/// The library's functions, exported as dotyk_multigrid_make and so on.
struct Doors {
  Outcome (*make)(const Matrix*, const Watcher*, void** solver, Message*) = nullptr;
  Outcome (*set)(void* solver, const algebra::SparseMatrix* lower, const std::vector<char>* held, const Watcher*, Message*) = nullptr;
  Outcome (*solve)(void* solver, const double* b, double tolerance, double* x, const Watcher*, Message*) = nullptr;
  void (*facts)(void* solver, Facts*) = nullptr;
  void (*drop)(void* solver) = nullptr;
};

}  // namespace dotyk::multigrid

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

/// The library's functions under the names that they are exported by.
struct Doors {
  Outcome (*make)(const Matrix*, const Watcher*, void** hierarchy, Message*) = nullptr;                                          // dotyk_multigrid_make
  Outcome (*set)(void*, const algebra::SparseMatrix* lower, const std::vector<char>* held, const Watcher*, Message*) = nullptr;  // dotyk_multigrid_set
  Outcome (*solve)(void*, const double* b, double tolerance, double* x, const Watcher*, Message*) = nullptr;                     // dotyk_multigrid_solve
  void (*facts)(void*, Facts*) = nullptr;                                                                                        // dotyk_multigrid_facts
  void (*drop)(void*) = nullptr;                                                                                                 // dotyk_multigrid_drop
};

}  // namespace dotyk::multigrid

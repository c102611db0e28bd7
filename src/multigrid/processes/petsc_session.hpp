// PETSc as a guest in this process: started once, silent, its signal handlers left out.
#pragma once

#include <petscksp.h>

#include <mutex>
#include <utility>

namespace dotyk::multigrid {

/// Starts PETSc, and the MPI that it needs, where that has not been done: it can only be done once a process. `spawns`: whether this process will start
/// others, or was started by one that does.
void start_petsc(bool spawns = false);
bool petsc_started();

/// Calls of PETSc and MPI are made while this is held.
std::mutex& only_one();

/// Throws std::runtime_error with PETSc's words where `code` is not 0.
void check(PetscErrorCode code);

/// Sole owner of an object of PETSc's.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Object object) : object_(object) {}
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Owned() { destroy(&object_); }

  operator Object() const { return object_; }
  Object* put() { return &object_; }  ///< for functions that make one

 private:
  Object object_ = nullptr;
};

/// The numbers of a vector that this process has, for as long as this lives.
template <class Number, PetscErrorCode (*get)(Vec, Number**), PetscErrorCode (*restore)(Vec, Number**)>
class NumbersOf {
 public:
  explicit NumbersOf(Vec of) : of_(of) { check(get(of_, &numbers_)); }
  ~NumbersOf() { restore(of_, &numbers_); }
  NumbersOf(const NumbersOf&) = delete;
  NumbersOf& operator=(const NumbersOf&) = delete;
  operator Number*() const { return numbers_; }

 private:
  Vec of_;
  Number* numbers_ = nullptr;
};
using Numbers = NumbersOf<PetscScalar, VecGetArray, VecRestoreArray>;
using ReadNumbers = NumbersOf<const PetscScalar, VecGetArrayRead, VecRestoreArrayRead>;

using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedPc = Owned<PC, PCDestroy>;

}  // namespace dotyk::multigrid

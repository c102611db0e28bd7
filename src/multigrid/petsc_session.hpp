// PETSc as a guest in this process: started once, silent, its signal handlers left out.
#pragma once

#include <petscksp.h>

#include <utility>

namespace dotyk::multigrid {

/// Starts PETSc, and the MPI that it needs, where that has not been done: it can only be done once a process. `spawns`: whether this process will start
/// others, or was started by one that does.
void start_petsc(bool spawns = false);
bool petsc_started();

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

using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedPc = Owned<PC, PCDestroy>;

}  // namespace dotyk::multigrid

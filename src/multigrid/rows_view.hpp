#pragma once

#include "multigrid/petsc_session.hpp"

namespace dotyk::multigrid {

/// A matrix of PETSc's as rows of numbers, columns ascending, for as long as this lives. PETSc then counts the numbers as changed.
class RowsView {
 public:
  explicit RowsView(Mat matrix) : matrix_(matrix) {
    PetscBool done = PETSC_FALSE;
    check(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done));
    check(MatSeqAIJGetArray(matrix_, &values));
  }
  ~RowsView() {
    PetscBool done = PETSC_FALSE;
    MatSeqAIJRestoreArray(matrix_, &values);
    MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done);
  }
  RowsView(const RowsView&) = delete;
  RowsView& operator=(const RowsView&) = delete;

  PetscInt count = 0;
  const PetscInt *starts = nullptr, *columns = nullptr;
  PetscScalar* values = nullptr;

 private:
  Mat matrix_;
};

/// Numbers were changed: what PETSc derived from them is out of date.
inline void tell_changed(Mat m) {
  { const RowsView counted(m); }
  check(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
}

}  // namespace dotyk::multigrid

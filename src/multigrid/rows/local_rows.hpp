// The rows of a matrix of PETSc's that this process has.
#pragma once

#include <array>
#include <optional>

#include "multigrid/processes/petsc_session.hpp"
#include "multigrid/processes/ranks.hpp"
#include "multigrid/rows/rows.hpp"

namespace dotyk::multigrid {

/// A sequential matrix as rows of numbers, columns ascending, for as long as this lives. PETSc then counts the numbers as changed.
class RowsView {
 public:
  explicit RowsView(Mat matrix);
  ~RowsView();
  RowsView(const RowsView&) = delete;
  RowsView& operator=(const RowsView&) = delete;

  PetscInt count = 0;
  const PetscInt *starts = nullptr, *columns = nullptr;
  PetscScalar* values = nullptr;

 private:
  Mat matrix_;
};

/// The rows of this rank, in two parts: of its own columns, and of others' where there are several ranks.
class LocalRows {
 public:
  explicit LocalRows(Mat matrix);

  int count() const { return own->count; }
  /// Calls visit(column by the numbers of all ranks, number) for the entries of a row: its own columns first.
  template <class Visit>
  void for_each(int row, Visit&& visit) const {
    for (int k = own->starts[row]; k < own->starts[row + 1]; ++k) visit(first_column + own->columns[k], own->values[k]);
    if (other)
      for (int k = other->starts[row]; k < other->starts[row + 1]; ++k) visit(others[other->columns[k]], other->values[k]);
  }

  std::optional<RowsView> own, other;
  const PetscInt* others = nullptr;            ///< by column of `other`: its number, ascending
  int first_row = 0, first_column = 0;
};

/// How many rows, and how many columns, of a matrix belong to a node.
struct BlockSize {
  explicit BlockSize(Mat matrix) { check(MatGetBlockSizes(matrix, &rows, &columns)); }
  PetscInt rows = 1, columns = 1;
};

/// A matrix with these rows; `blocks`: its BlockSize. It uses the arrays of `rows` and `others`, which must outlive it: entries in columns of other ranks are
/// moved from `rows` to `others`. Collective.
OwnedMat matrix_of(const Ranks& ranks, Rows& rows, Rows& others, int own_columns, std::array<int, 2> blocks);

/// A matrix with these rows, which it copies. Collective.
OwnedMat copied(const Ranks& ranks, const Rows& rows, int own_columns);

/// Numbers were changed: what PETSc derived from them is out of date.
void tell_changed(Mat m);

/// The ranks of a matrix.
Ranks ranks_of(Mat m);

}  // namespace dotyk::multigrid

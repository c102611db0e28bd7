#include "multigrid/local_rows.hpp"

#include <algorithm>

namespace dotyk::multigrid {

RowsView::RowsView(Mat matrix) : matrix_(matrix) {
  PetscBool done = PETSC_FALSE;
  check(MatGetRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done));
  check(MatSeqAIJGetArray(matrix_, &values));
}

RowsView::~RowsView() {
  PetscBool done = PETSC_FALSE;
  MatSeqAIJRestoreArray(matrix_, &values);
  MatRestoreRowIJ(matrix_, 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done);
}

LocalRows::LocalRows(Mat matrix) {
  PetscInt last = 0;
  check(MatGetOwnershipRange(matrix, &first_row, nullptr));
  check(MatGetOwnershipRangeColumn(matrix, &first_column, &last));
  own_columns = last - first_column;
  if (ranks_of(matrix).alone()) {
    own.emplace(matrix);
    return;
  }
  Mat diagonal = nullptr, rest = nullptr;
  check(MatMPIAIJGetSeqAIJ(matrix, &diagonal, &rest, &others));
  own.emplace(diagonal), other.emplace(rest);
  check(MatGetSize(rest, nullptr, &others_count));
}

double* LocalRows::find(int row, int column) const {
  const bool mine = column >= first_column && column < first_column + own_columns;
  const RowsView& part = mine ? *own : *other;
  int local = column - first_column;
  if (!mine) {
    const PetscInt* at = std::lower_bound(others, others + others_count, column);
    if (at == others + others_count || *at != column) return nullptr;
    local = static_cast<int>(at - others);
  }
  const PetscInt *end = part.columns + part.starts[row + 1], *at = std::lower_bound(part.columns + part.starts[row], end, local);
  return at == end || *at != local ? nullptr : part.values + (at - part.columns);
}

OwnedMat matrix_of(const Ranks& ranks, Rows& rows, int own_columns, std::array<int, 2> blocks) {
  OwnedMat m;
  const int count = static_cast<int>(rows.starts.size()) - 1;
  if (ranks.alone()) {
    check(MatCreateSeqAIJWithArrays(ranks.comm(), count, own_columns, rows.starts.data(), rows.columns.data(), rows.values.data(), m.put()));
    check(MatSetBlockSizes(m, blocks[0], blocks[1]));
    return m;
  }
  check(MatCreate(ranks.comm(), m.put()));
  check(MatSetSizes(m, count, own_columns, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSizes(m, blocks[0], blocks[1]));
  check(MatSetType(m, MATMPIAIJ));
  check(MatMPIAIJSetPreallocationCSR(m, rows.starts.data(), rows.columns.data(), rows.values.data()));
  rows = Rows();
  return m;
}

void tell_changed(Mat m) {
  { const LocalRows counted(m); }
  check(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
}

Ranks ranks_of(Mat m) {
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(static_cast<Mat>(m)), &comm));
  return Ranks(comm);
}

}  // namespace dotyk::multigrid

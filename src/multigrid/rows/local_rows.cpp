#include "multigrid/rows/local_rows.hpp"

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
  check(MatGetOwnershipRange(matrix, &first_row, nullptr));
  check(MatGetOwnershipRangeColumn(matrix, &first_column, nullptr));
  if (ranks_of(matrix).alone()) {
    own.emplace(matrix);
    return;
  }
  Mat diagonal = nullptr, rest = nullptr;
  check(MatMPIAIJGetSeqAIJ(matrix, &diagonal, &rest, &others));
  own.emplace(diagonal), other.emplace(rest);
}

namespace {

/// Leaves the columns first … first + count − 1 in `rows`, counted from `first`, and puts the others into `others`.
void split(Rows& rows, Rows& others, int first, int count) {
  int kept = 0;
  for (std::size_t i = 0, k = 0; i + 1 < rows.starts.size(); ++i) {
    for (const std::size_t end = static_cast<std::size_t>(rows.starts[i + 1]); k < end; ++k) {
      const int column = rows.columns[k] - first;
      if (column >= 0 && column < count) {
        rows.columns[kept] = column, rows.values[kept++] = rows.values[k];
      } else {
        others.columns.push_back(rows.columns[k]), others.values.push_back(rows.values[k]);
      }
    }
    rows.starts[i + 1] = kept;
    others.starts.push_back(counted(others.columns.size()));
  }
}

}  // namespace

OwnedMat matrix_of(const Ranks& ranks, Rows& rows, Rows& others, int own_columns, std::array<int, 2> blocks) {
  OwnedMat m;
  const int count = static_cast<int>(rows.starts.size()) - 1;
  if (ranks.alone()) {
    check(MatCreateSeqAIJWithArrays(ranks.comm(), count, own_columns, rows.starts.data(), rows.columns.data(), rows.values.data(), m.put()));
  } else {
    split(rows, others, ranks.before(own_columns), own_columns);
    check(MatCreateMPIAIJWithSplitArrays(ranks.comm(), count, own_columns, PETSC_DETERMINE, PETSC_DETERMINE, rows.starts.data(), rows.columns.data(),
                                         rows.values.data(), others.starts.data(), others.columns.data(), others.values.data(), m.put()));
  }
  check(MatSetBlockSizes(m, blocks[0], blocks[1]));
  return m;
}

OwnedMat copied(const Ranks& ranks, const Rows& rows, int own_columns) {
  const int count = static_cast<int>(rows.starts.size()) - 1;
  OwnedMat m;
  check(MatCreate(ranks.comm(), m.put()));
  check(MatSetSizes(m, count, own_columns, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(m, ranks.alone() ? MATSEQAIJ : MATMPIAIJ));
  check(ranks.alone() ? MatSeqAIJSetPreallocationCSR(m, rows.starts.data(), rows.columns.data(), rows.values.data())
                      : MatMPIAIJSetPreallocationCSR(m, rows.starts.data(), rows.columns.data(), rows.values.data()));
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

#include "multigrid/border.hpp"

#include "multigrid/local_rows.hpp"

namespace dotyk::multigrid {

Border::Border(Mat A) {
  if (ranks_of(A).alone()) return;
  {
    const LocalRows view(A);
    for (int row = 0; row < view.count(); ++row) {
      const int begin = view.other->starts[row], end = view.other->starts[row + 1];
      if (begin == end) continue;
      rows_.push_back(row);
      columns_.insert(columns_.end(), view.other->columns + begin, view.other->columns + end);
      starts_.push_back(static_cast<int>(columns_.size()));
    }
    Owned<IS, ISDestroy> columns;
    OwnedVec all;
    check(MatCreateVecs(A, all.put(), nullptr));
    check(ISCreateGeneral(PETSC_COMM_SELF, view.others_count, view.others, PETSC_COPY_VALUES, columns.put()));
    check(VecCreateSeq(PETSC_COMM_SELF, view.others_count, theirs_.put()));
    check(VecScatterCreate(all, columns, theirs_, nullptr, scatter_.put()));
  }
  product_.resize(rows_.size());
  fetch(A);
}

void Border::fetch(Mat A) {
  if (rows_.empty()) return;
  const LocalRows view(A);
  values_.clear();
  for (const int row : rows_) values_.insert(values_.end(), view.other->values + view.other->starts[row], view.other->values + view.other->starts[row + 1]);
}

const std::vector<double>& Border::times(Vec v) {
  if (!scatter_) return product_;
  check(VecScatterBegin(scatter_, v, theirs_, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter_, v, theirs_, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* theirs = nullptr;
  check(VecGetArrayRead(theirs_, &theirs));
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    double sum = 0;
    for (int e = starts_[k]; e < starts_[k + 1]; ++e) sum += values_[e] * theirs[columns_[e]];
    product_[k] = sum;
  }
  check(VecRestoreArrayRead(theirs_, &theirs));
  return product_;
}

}  // namespace dotyk::multigrid

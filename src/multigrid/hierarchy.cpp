#include "multigrid/hierarchy.hpp"

#include <algorithm>
#include <cstdlib>

#include "multigrid/near_kernel.hpp"

namespace dotyk::multigrid {

namespace {

/// What GAMG would set up for its own cycle, which is not used: as little as it can be told to.
void leave_out_smoothers(PC pc) {
  check(PCSetOptionsPrefix(pc, "dotyk_"));
  check(PetscOptionsSetValue(nullptr, "-dotyk_mg_levels_ksp_type", "richardson"));
  check(PetscOptionsSetValue(nullptr, "-dotyk_mg_levels_pc_type", "none"));
}

double knob(const char* name, double value) { return std::getenv(name) ? std::atof(std::getenv(name)) : value; }

OwnedPc aggregate(Mat finest) {
  OwnedPc pc;
  check(PCCreate(PETSC_COMM_SELF, pc.put()));
  check(PCSetOperators(pc, finest, finest));
  check(PCSetType(pc, PCGAMG));
  leave_out_smoothers(pc);
  PetscReal threshold = knob("MG_THRESHOLD", 0.0);
  check(PCGAMGSetThreshold(pc, &threshold, 1));
  check(PCGAMGSetThresholdScale(pc, knob("MG_SCALE", 1.0)));
  check(PCGAMGSetAggressiveLevels(pc, static_cast<int>(knob("MG_AGGRESSIVE", 1))));
  check(PCGAMGSetNSmooths(pc, static_cast<int>(knob("MG_NSMOOTHS", 1))));
  check(PCGAMGSetCoarseEqLim(pc, static_cast<int>(knob("MG_COARSE", 400))));
  check(PCSetUp(pc));
  return pc;
}

/// Numbers were changed in its arrays: what PETSc keeps of them beside these is out of date.
void tell_changed(Mat m) {
  PetscScalar* values = nullptr;
  check(MatSeqAIJGetArray(m, &values));
  check(MatSeqAIJRestoreArray(m, &values));  // counts as a change
  check(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
}

/// A coarse matrix is singular where coarse functions vanish, or agree, after truncation. A diagonal greater by a tiny factor, and
/// one where there is none, makes it definite; what the cycle does elsewhere is not changed noticeably.
void make_definite(Mat coarse) {
  constexpr double kFactor = 1e-10;
  PetscInt n = 0;
  const PetscInt *starts = nullptr, *columns = nullptr;
  PetscBool done = PETSC_FALSE;
  PetscScalar* values = nullptr;
  check(MatGetRowIJ(coarse, 0, PETSC_FALSE, PETSC_FALSE, &n, &starts, &columns, &done));
  check(MatSeqAIJGetArray(coarse, &values));
  double greatest = 0;
  std::vector<double*> diagonal(static_cast<std::size_t>(n), nullptr);
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt* at = std::lower_bound(columns + starts[i], columns + starts[i + 1], i);
    if (at == columns + starts[i + 1] || *at != i) continue;
    diagonal[i] = values + (at - columns);
    greatest = std::max(greatest, *diagonal[i]);
  }
  if (!(greatest > 0)) greatest = 1;
  bool whole = true;
  for (double* d : diagonal)
    if (d)
      *d = *d > kFactor * greatest ? *d * (1 + kFactor) : greatest;
    else
      whole = false;
  check(MatSeqAIJRestoreArray(coarse, &values));
  check(MatRestoreRowIJ(coarse, 0, PETSC_FALSE, PETSC_FALSE, &n, &starts, &columns, &done));
  if (!whole) throw std::runtime_error("multigrid: a coarse matrix has no diagonal");
  tell_changed(coarse);
}

double bytes_of(Mat m) {
  MatInfo info;
  check(MatGetInfo(m, MAT_LOCAL, &info));
  return 12.0 * info.nz_allocated;
}

}  // namespace

Hierarchy::Hierarchy(const Matrix& matrix) : embedding_(matrix.lower, matrix.node) {
  embedding_.fill(matrix.lower);
  Embedding& e = embedding_;
  matrices_.emplace_back();
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, e.rows(), e.rows(), e.starts().data(), e.columns().data(), e.values().data(), matrices_[0].put()));
  check(MatSetBlockSize(matrices_[0], e.block()));
  check(MatSetOption(matrices_[0], MAT_SPD, PETSC_TRUE));
  coarsen(matrix.near_kernel);
}

void Hierarchy::coarsen(const algebra::DenseMatrix& near_kernel) {
  attach_near_kernel(matrices_[0], embedding_, near_kernel);
  const OwnedPc pc = aggregate(matrices_[0]);
  check(MatSetNearNullSpace(matrices_[0], nullptr));
  PetscInt count = 0, coarse = 0;
  Mat *interpolations = nullptr, *operators = nullptr;
  check(PCGetInterpolations(pc, &count, &interpolations));  // the coarsest first, each with a reference for us
  check(PCGetCoarseOperators(pc, &coarse, &operators));
  for (PetscInt l = count - 2; l >= 0; --l) {
    interpolations_.emplace_back(interpolations[l]);
    matrices_.emplace_back(operators[l]);
  }
  check(PetscFree(interpolations));
  check(PetscFree(operators));
  if (interpolations_.empty()) return;
  MatInfo info;
  check(MatGetInfo(interpolations_[0], MAT_LOCAL, &info));
  const PetscScalar* values = nullptr;
  check(MatSeqAIJGetArrayRead(interpolations_[0], &values));
  finest_interpolation_.assign(values, values + static_cast<std::size_t>(info.nz_used));
  check(MatSeqAIJRestoreArrayRead(interpolations_[0], &values));
}

void Hierarchy::truncate(const std::vector<char>& held) {
  Mat P = interpolations_[0];
  PetscInt n = 0;
  const PetscInt *starts = nullptr, *columns = nullptr;
  PetscBool done = PETSC_FALSE;
  PetscScalar* values = nullptr;
  check(MatGetRowIJ(P, 0, PETSC_FALSE, PETSC_FALSE, &n, &starts, &columns, &done));
  check(MatSeqAIJGetArray(P, &values));
  std::copy(finest_interpolation_.begin(), finest_interpolation_.end(), values);
  const auto clear = [&](int slot) { std::fill(values + starts[slot], values + starts[slot + 1], 0.0); };
  for (const int slot : embedding_.idle()) clear(slot);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) clear(embedding_.slot()[i]);
  check(MatSeqAIJRestoreArray(P, &values));
  check(MatRestoreRowIJ(P, 0, PETSC_FALSE, PETSC_FALSE, &n, &starts, &columns, &done));
  tell_changed(P);
}

bool Hierarchy::set(const algebra::SparseMatrix& lower, const std::vector<char>& held) {
  if (!embedding_.fill(lower)) return false;
  tell_changed(matrices_[0]);
  if (!interpolations_.empty()) truncate(held);
  for (std::size_t l = 0; l < interpolations_.size(); ++l) {
    check(MatPtAP(matrices_[l], interpolations_[l], MAT_REUSE_MATRIX, PETSC_DEFAULT, matrices_[l + 1].put()));
    make_definite(matrices_[l + 1]);
  }
  return true;
}

double Hierarchy::bytes() const {
  double sum = embedding_.bytes() + 8.0 * static_cast<double>(finest_interpolation_.size());
  for (std::size_t l = 1; l < matrices_.size(); ++l) sum += bytes_of(matrices_[l]) + bytes_of(interpolations_[l - 1]);
  return sum;
}

}  // namespace dotyk::multigrid

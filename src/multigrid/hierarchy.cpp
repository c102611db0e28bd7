#include "multigrid/hierarchy.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace dotyk::multigrid {

namespace {

/// What GAMG would set up for its own cycle, which is not used: as little as it can be told to.
void leave_out_smoothers(PC pc) {
  check(PCSetOptionsPrefix(pc, "dotyk_"));
  check(PetscOptionsSetValue(nullptr, "-dotyk_mg_levels_ksp_type", "richardson"));
  check(PetscOptionsSetValue(nullptr, "-dotyk_mg_levels_pc_type", "none"));
}

/// As GAMG chooses them by default, save the size of the coarsest. Measured on a cube of 200 000 unknowns, processor seconds of one
/// construction and five times new numbers with a solution to 1e-3: 5.6; no pairs of aggregates joined 16.3, joined on two levels 6.9; prolongator
/// not smoothed 7.0, and iterations grow with the mesh, smoothed twice 17.2; threshold 0.02 6.9; Chebyshev's smoother of two steps 7.3.
OwnedPc aggregate(Mat finest) {
  OwnedPc pc;
  check(PCCreate(PETSC_COMM_SELF, pc.put()));
  check(PCSetOperators(pc, finest, finest));
  check(PCSetType(pc, PCGAMG));
  leave_out_smoothers(pc);
  PetscReal threshold = 0;
  check(PCGAMGSetThreshold(pc, &threshold, 1));
  check(PCGAMGSetAggressiveLevels(pc, 1));
  check(PCGAMGSetNSmooths(pc, 1));
  check(PCGAMGSetCoarseEqLim(pc, 400));
  check(PCSetUp(pc));
  return pc;
}

/// A coarse matrix is singular where coarse functions vanish, or agree, after truncation. A diagonal greater by a tiny factor, and
/// one where there is none, makes it definite; what the cycle does elsewhere is not changed noticeably. Of the given rows.
void make_definite(Mat coarse, const std::vector<char>& rows) {
  constexpr double kFactor = 1e-10;
  RowsView C(coarse);
  std::vector<double*> diagonal(rows.size(), nullptr);
  double greatest = 0;
  for (int i = 0; i < C.count; ++i) {
    const PetscInt *end = C.columns + C.starts[i + 1], *at = std::lower_bound(C.columns + C.starts[i], end, i);
    if (at == end || *at != i) throw std::runtime_error("multigrid: a coarse matrix has no diagonal");
    diagonal[i] = C.values + (at - C.columns);
    greatest = std::max(greatest, *diagonal[i]);
  }
  if (!(greatest > 0)) greatest = 1;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i]) *diagonal[i] = *diagonal[i] > kFactor * greatest ? *diagonal[i] * (1 + kFactor) : greatest;
}

double bytes_of(Mat m) {
  MatInfo info;
  check(MatGetInfo(m, MAT_LOCAL, &info));
  return 12.0 * info.nz_allocated;
}

/// The embedded matrix, in the embedding's own arrays.
OwnedMat view(Embedding& e) {
  OwnedMat m;
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, e.rows(), e.rows(), e.starts().data(), e.columns().data(), e.values().data(), m.put()));
  check(MatSetBlockSize(m, e.block()));
  check(MatSetOption(m, MAT_SPD, PETSC_TRUE));
  return m;
}

/// Tells `finest` the motions that take little energy: the modes, made orthonormal by Gram and Schmidt, twice, as rotations about a distant
/// point are almost translations, and dependent ones left out.
void attach_near_kernel(Mat finest, const Embedding& e, const algebra::DenseMatrix& modes) {
  constexpr double kDependent = 1e-10;
  std::vector<algebra::Vector> basis;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    algebra::Vector v = modes.col(k);
    const double before = v.norm();
    for (int pass = 0; pass < 2; ++pass)
      for (const algebra::Vector& q : basis) v -= q.dot(v) * q;
    if (v.norm() > kDependent * before) basis.push_back(v.normalized());
  }
  if (basis.empty()) return;
  std::vector<OwnedVec> vecs;
  for (const algebra::Vector& mode : basis) {
    PetscScalar* values = nullptr;
    check(MatCreateVecs(finest, vecs.emplace_back().put(), nullptr));
    check(VecGetArrayWrite(vecs.back(), &values));
    std::fill(values, values + e.rows(), 0.0);
    for (std::size_t i = 0; i < e.slot().size(); ++i) values[e.slot()[i]] = mode[static_cast<Eigen::Index>(i)];
    check(VecRestoreArrayWrite(vecs.back(), &values));
  }
  const std::vector<Vec> plain(vecs.begin(), vecs.end());
  Owned<MatNullSpace, MatNullSpaceDestroy> space;
  check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, static_cast<PetscInt>(plain.size()), plain.data(), space.put()));
  check(MatSetNearNullSpace(finest, space));
}

/// S between slots, idle ones as they are.
OwnedMat embedded(const algebra::SparseMatrix& S, const Embedding& e) {
  const algebra::SparseRows rows = S;
  std::vector<PetscInt> starts{0}, columns;
  std::vector<PetscScalar> values;
  std::vector<int> unknown(static_cast<std::size_t>(e.rows()), -1);
  for (std::size_t i = 0; i < e.slot().size(); ++i) unknown[e.slot()[i]] = static_cast<int>(i);
  for (int slot = 0; slot < e.rows(); ++slot) {
    if (unknown[slot] < 0) columns.push_back(slot), values.push_back(1);
    else
      for (algebra::SparseRows::InnerIterator it(rows, unknown[slot]); it; ++it) columns.push_back(e.slot()[it.col()]), values.push_back(it.value());
    starts.push_back(static_cast<PetscInt>(columns.size()));
  }
  OwnedMat views, m;
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, e.rows(), e.rows(), starts.data(), columns.data(), values.data(), views.put()));
  check(MatDuplicate(views, MAT_COPY_VALUES, m.put()));
  check(MatSetBlockSize(m, e.block()));
  return m;
}

}  // namespace

Hierarchy::Hierarchy(const Matrix& matrix) : embedding_(matrix.lower, matrix.node) {
  empty_.assign(static_cast<std::size_t>(embedding_.rows()), 0);
  std::vector<char> changed(empty_);
  if (!embedding_.fill(matrix.lower, changed)) throw std::runtime_error("multigrid: the diagonal of the matrix is not positive");
  matrices_.push_back(view(embedding_));
  coarsen(matrix);
}

void Hierarchy::coarsen(const Matrix& matrix) {
  std::optional<Embedding> own;  // of displacements, where unknowns are others
  OwnedMat displaced;
  if (matrix.displaced) {
    own.emplace(*matrix.displaced, matrix.node);
    std::vector<char> changed(static_cast<std::size_t>(own->rows()));
    if (!own->fill(*matrix.displaced, changed)) throw std::runtime_error("multigrid: the diagonal of the stiffness is not positive");
    displaced = view(*own);
  }
  const Mat finest = own ? displaced : matrices_[0];
  attach_near_kernel(finest, embedding_, matrix.near_kernel);
  const OwnedPc pc = aggregate(finest);
  check(MatSetNearNullSpace(finest, nullptr));
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
  if (own && !interpolations_.empty()) {
    const OwnedMat S = embedded(*matrix.unknowns, embedding_);
    find_shared(S, displaced);
    take_unknowns(S);
  }
  for (std::size_t l = 0; l < interpolations_.size(); ++l) {
    check(MatProductClear(matrices_[l + 1]));  // what PETSc keeps for its own product
    products_.emplace_back(interpolations_[l], matrices_[l + 1]);
  }
  if (interpolations_.empty()) return;
  const RowsView P(interpolations_[0]);
  finest_interpolation_.assign(P.values, P.values + P.starts[P.count]);
}

void Hierarchy::take_unknowns(Mat S) {
  OwnedMat interpolation;
  check(MatMatMult(S, interpolations_[0], MAT_INITIAL_MATRIX, PETSC_DEFAULT, interpolation.put()));
  check(MatProductClear(interpolation));
  interpolations_[0] = std::move(interpolation);
  for (std::size_t l = 0; l < interpolations_.size(); ++l) {  // bodies that nothing joined meet in these patterns
    OwnedMat coarse;
    check(MatPtAP(matrices_[l], interpolations_[l], MAT_INITIAL_MATRIX, PETSC_DEFAULT, coarse.put()));
    matrices_[l + 1] = std::move(coarse);
  }
}

void Hierarchy::find_shared(Mat S, Mat displaced) {
  constexpr double kStiffer = 2;
  OwnedVec diagonal;
  check(MatCreateVecs(displaced, diagonal.put(), nullptr));
  check(MatGetDiagonal(displaced, diagonal));
  const PetscScalar* k = nullptr;
  check(VecGetArrayRead(diagonal, &k));
  const RowsView rows(S);
  std::vector<double> brought(static_cast<std::size_t>(rows.count), 0.0);  // stiffness, by jumps
  const auto each_pair = [&](auto&& visit) {
    for (int i = 0; i < rows.count; ++i)
      for (int at = rows.starts[i]; at < rows.starts[i + 1]; ++at)
        if (rows.columns[at] != i) visit(i, rows.columns[at], rows.values[at]);
  };
  each_pair([&](int i, int j, double factor) { brought[j] += k[i] * factor * factor; });
  each_pair([&](int i, int j, double) {
    if (brought[j] > kStiffer * k[j]) shared_.insert({i, j});
  });
  check(VecRestoreArrayRead(diagonal, &k));
}

std::vector<PetscInt> Hierarchy::shared() const {
  std::vector<PetscInt> slots;
  std::copy_if(shared_.begin(), shared_.end(), std::back_inserter(slots), [&](int slot) { return !empty_[slot]; });
  return slots;
}

void Hierarchy::truncate(const std::vector<char>& held, std::vector<char>& changed) {
  RowsView P(interpolations_[0]);
  std::vector<char> empty(changed.size(), 0);
  for (const int slot : embedding_.idle()) empty[slot] = 1;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) empty[embedding_.slot()[i]] = 1;
  for (int i = 0; i < P.count; ++i) {
    if (empty[i] == empty_[i]) continue;
    changed[i] = 1;
    for (int k = P.starts[i]; k < P.starts[i + 1]; ++k) P.values[k] = empty[i] ? 0.0 : finest_interpolation_[k];
  }
  empty_ = empty;
}

bool Hierarchy::set(const algebra::SparseMatrix& lower, const std::vector<char>& held) {
  std::vector<char> changed(static_cast<std::size_t>(embedding_.rows()), fresh_);
  if (!embedding_.fill(lower, changed)) return false;
  tell_changed(matrices_[0]);
  if (!interpolations_.empty()) {
    truncate(held, changed);
    tell_changed(interpolations_[0]);
  }
  fresh_ = true;  // until all levels are done
  for (std::size_t l = 0; l < interpolations_.size(); ++l) {
    changed = products_[l].compute(matrices_[l], interpolations_[l], matrices_[l + 1], changed);
    make_definite(matrices_[l + 1], changed);
    tell_changed(matrices_[l + 1]);
  }
  fresh_ = false;
  return true;
}

double Hierarchy::bytes() const {
  double sum = embedding_.bytes() + 8.0 * static_cast<double>(finest_interpolation_.size());
  for (std::size_t l = 1; l < matrices_.size(); ++l) sum += bytes_of(matrices_[l]) + bytes_of(interpolations_[l - 1]) + products_[l - 1].bytes();
  return sum;
}

}  // namespace dotyk::multigrid

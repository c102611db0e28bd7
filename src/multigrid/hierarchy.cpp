#include "multigrid/hierarchy.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
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

/// Tells `finest` the motions that take little energy: the modes, one row a slot, made orthonormal by Gram and Schmidt, twice, as rotations about a
/// distant point are almost translations, and dependent ones left out.
void attach_near_kernel(Mat finest, const algebra::DenseMatrix& modes, const std::vector<int>& slots) {
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
    PetscInt rows = 0;
    check(MatCreateVecs(finest, vecs.emplace_back().put(), nullptr));
    check(VecGetArrayWrite(vecs.back(), &values));
    check(VecGetSize(vecs.back(), &rows));
    std::fill(values, values + rows, 0.0);
    for (std::size_t i = 0; i < slots.size(); ++i) values[slots[i]] = mode[static_cast<Eigen::Index>(i)];
    check(VecRestoreArrayWrite(vecs.back(), &values));
  }
  const std::vector<Vec> plain(vecs.begin(), vecs.end());
  Owned<MatNullSpace, MatNullSpaceDestroy> space;
  check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, static_cast<PetscInt>(plain.size()), plain.data(), space.put()));
  check(MatSetNearNullSpace(finest, space));
}

/// The same matrix as PETSc's; `blocks`: how many rows, and how many columns, belong to a node.
OwnedMat matrix_of(const algebra::SparseRows& rows, std::array<int, 2> blocks) {
  OwnedMat m;
  Eigen::VectorXi counts(rows.rows());
  for (int i = 0; i < rows.rows(); ++i) counts[i] = rows.outerIndexPtr()[i + 1] - rows.outerIndexPtr()[i];
  check(MatCreateSeqAIJ(PETSC_COMM_SELF, rows.rows(), rows.cols(), 0, counts.data(), m.put()));
  check(MatSetBlockSizes(m, blocks[0], blocks[1]));
  for (int i = 0; i < rows.rows(); ++i) {
    const int begin = rows.outerIndexPtr()[i];
    check(MatSetValues(m, 1, &i, counts[i], rows.innerIndexPtr() + begin, rows.valuePtr() + begin, INSERT_VALUES));
  }
  check(MatAssemblyBegin(m, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(m, MAT_FINAL_ASSEMBLY));
  return m;
}

/// The rows of unknowns as rows of slots; `between`: columns likewise, idle slots as they are.
algebra::SparseRows in_slots(const algebra::SparseRows& rows, const Embedding& e, bool between) {
  algebra::Triplets entries;
  for (int i = 0; i < rows.rows(); ++i)
    for (algebra::SparseRows::InnerIterator it(rows, i); it; ++it)
      entries.emplace_back(e.slot()[i], between ? e.slot()[it.col()] : static_cast<int>(it.col()), it.value());
  if (between)
    for (const int i : e.idle()) entries.emplace_back(i, i, 1.0);
  return algebra::from_triplets<algebra::SparseRows>(e.rows(), between ? e.rows() : rows.cols(), entries);
}

/// S P, with the blocks of P.
OwnedMat product(Mat S, Mat P) {
  OwnedMat m;
  check(MatMatMult(S, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, m.put()));
  check(MatProductClear(m));
  PetscInt rows = 1, columns = 1;
  check(MatGetBlockSizes(P, &rows, &columns));
  check(MatSetBlockSizes(m, rows, columns));
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
  constexpr std::size_t kLarge = 2000;  // for a factor on the coarsest level
  OwnedMat S;
  if (matrix.unknowns) {
    S = matrix_of(in_slots(*matrix.unknowns, embedding_, true), {embedding_.block(), embedding_.block()});
    find_shared(matrix);
  }
  if (matrix.coarse) {
    take_functions(matrix, S);
    std::vector<int> slots(static_cast<std::size_t>(matrix.near_kernel.rows()));
    std::iota(slots.begin(), slots.end(), 0);
    if (slots.size() > kLarge) {
      fill_coarse(std::vector<char>(empty_.size(), 1));
      take_aggregates(matrices_.back(), matrix.near_kernel, slots);
    }
  } else if (matrix.displaced) {
    Embedding own(*matrix.displaced, matrix.node);
    std::vector<char> changed(static_cast<std::size_t>(own.rows()));
    if (!own.fill(*matrix.displaced, changed)) throw std::runtime_error("multigrid: the diagonal of the stiffness is not positive");
    take_aggregates(view(own), matrix.near_kernel, embedding_.slot());
    take_unknowns(S);
  } else {
    take_aggregates(matrices_[0], matrix.near_kernel, embedding_.slot());
  }
  for (std::size_t l = products_.size(); l < interpolations_.size(); ++l) {
    check(MatProductClear(matrices_[l + 1]));  // what PETSc keeps for its own product
    products_.emplace_back(interpolations_[l], matrices_[l + 1]);
  }
}

void Hierarchy::take_functions(const Matrix& matrix, Mat S) {
  for (const algebra::SparseRows& functions : *matrix.coarse) {
    const bool first = interpolations_.empty();
    OwnedMat P = first ? matrix_of(in_slots(functions, embedding_, false), {embedding_.block(), matrix.dimension})
                       : matrix_of(functions, {matrix.dimension, matrix.dimension});
    if (first && S) P = product(S, P);
    matrices_.push_back(coarse_matrix(matrices_.back(), P));
    products_.emplace_back(P, matrices_.back());
    interpolations_.push_back(std::move(P));
  }
}

void Hierarchy::take_aggregates(Mat finest, const algebra::DenseMatrix& modes, const std::vector<int>& slots) {
  attach_near_kernel(finest, modes, slots);
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
}

void Hierarchy::take_unknowns(Mat S) {
  if (interpolations_.empty()) return;
  interpolations_[0] = product(S, interpolations_[0]);
  for (std::size_t l = 0; l < interpolations_.size(); ++l)  // bodies that nothing joined meet in these patterns
    matrices_[l + 1] = coarse_matrix(matrices_[l], interpolations_[l]);
}

void Hierarchy::find_shared(const Matrix& matrix) {
  constexpr double kStiffer = 2;
  const algebra::Vector k = matrix.displaced->diagonal();
  const algebra::SparseRows S = *matrix.unknowns;
  algebra::Vector brought = algebra::Vector::Zero(k.size()), carried = brought;  // stiffness, to an unknown by rows, and by a row to others
  const auto each_pair = [&](auto&& visit) {
    for (int i = 0; i < S.rows(); ++i)
      for (algebra::SparseRows::InnerIterator it(S, i); it; ++it)
        if (it.col() != i) visit(i, static_cast<int>(it.col()), it.value());
  };
  each_pair([&](int i, int j, double factor) {
    const double whole = S.coeff(i, i), stiffness = k[i] * (factor / whole) * (factor / whole);
    brought[j] += stiffness, carried[i] += stiffness / k[j];
  });
  each_pair([&](int i, int j, double) {
    if (brought[j] > kStiffer * k[j] || carried[i] > kStiffer) shared_.insert({embedding_.slot()[i], embedding_.slot()[j]});
  });
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
    double *begin = P.values + P.starts[i], *end = P.values + P.starts[i + 1];
    if (empty[i]) {
      emptied_[i].assign(begin, end);
      std::fill(begin, end, 0.0);
    } else {
      std::copy_n(emptied_.extract(i).mapped().begin(), end - begin, begin);
    }
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
  fill_coarse(std::move(changed));
  fresh_ = false;
  return true;
}

void Hierarchy::fill_coarse(std::vector<char> changed) {
  for (std::size_t l = 0; l < products_.size(); ++l) {
    changed = products_[l].compute(matrices_[l], interpolations_[l], matrices_[l + 1], changed);
    make_definite(matrices_[l + 1], changed);
    tell_changed(matrices_[l + 1]);
  }
}

double Hierarchy::bytes() const {
  double sum = embedding_.bytes();
  for (std::size_t l = 1; l < matrices_.size(); ++l) sum += bytes_of(matrices_[l]) + bytes_of(interpolations_[l - 1]) + products_[l - 1].bytes();
  return sum;
}

}  // namespace dotyk::multigrid

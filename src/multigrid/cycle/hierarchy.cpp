#include "multigrid/cycle/hierarchy.hpp"

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
  check(PCCreate(ranks_of(finest).comm(), pc.put()));
  check(PCSetOperators(pc, finest, finest));
  check(PCSetType(pc, PCGAMG));
  leave_out_smoothers(pc);
  // "rap" is faster, but takes half as much memory again as all the rest. Parallel matrices have other algorithms.
  constexpr PetscInt kFew = 100'000;
  PetscInt rows = 0;
  check(MatGetSize(finest, &rows, nullptr));
  const bool alone = ranks_of(finest).alone();
  check(alone ? PetscOptionsSetValue(nullptr, "-matptap_via", rows < kFew ? "rap" : "scalable") : PetscOptionsClearValue(nullptr, "-matptap_via"));
  PetscReal threshold = 0;
  check(PCGAMGSetThreshold(pc, &threshold, 1));
  check(PCGAMGSetAggressiveLevels(pc, 1));
  check(PCGAMGSetNSmooths(pc, 1));
  check(PCGAMGSetCoarseEqLim(pc, 400));
  check(PCSetUp(pc));
  check(PetscOptionsClearValue(nullptr, "-matptap_via"));
  return pc;
}

/// A coarse matrix is singular where coarse functions vanish, or agree, after truncation. A diagonal greater by a tiny factor, and
/// one where there is none, makes it definite; what the cycle does elsewhere is not changed noticeably. Of the given rows.
void make_definite(HalfMatrix& coarse, const std::vector<char>& rows) {
  constexpr double kFactor = 1e-10;
  double greatest = 0;
  for (int i = 0; i < coarse.rows(); ++i) greatest = std::max(greatest, coarse.diagonal(i));
  greatest = coarse.ranks().greatest(greatest);
  if (!(greatest > 0)) greatest = 1;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (double& d = coarse.diagonal(static_cast<int>(i)); rows[i]) d = d > kFactor * greatest ? d * (1 + kFactor) : greatest;
}

HalfMatrix half_of(Mat matrix) {
  const int block = BlockSize(matrix).rows;
  const LocalRows view(matrix);
  const auto each = [&](auto&& visit) {
    for (int row = 0; row < view.count(); ++row)
      view.for_each(row, [&](int column, double number) {
        if (column <= view.first_row + row || column >= view.first_row + view.count()) visit(view.first_row + row, column, number);
      });
  };
  return HalfMatrix(ranks_of(matrix), half_rows(block, view.first_row / block, view.count() / block, each));
}

double bytes_of(Mat m) {
  MatInfo info;
  check(MatGetInfo(m, MAT_LOCAL, &info));
  return 12.0 * info.nz_allocated;
}

/// Tells `finest` the motions that take little energy: the modes, columns of its own rows, made orthonormal by Gram and Schmidt, twice, as rotations about
/// a distant point are almost translations, and dependent ones left out.
void attach_near_kernel(Mat finest, const std::vector<double>& modes, int count) {
  constexpr double kDependent = 1e-10;
  std::vector<OwnedVec> basis;
  for (int k = 0; k < count; ++k) {
    OwnedVec v;
    check(MatCreateVecs(finest, v.put(), nullptr));
    PetscScalar* values = nullptr;
    check(VecGetArrayWrite(v, &values));
    std::copy_n(modes.begin() + k * static_cast<std::ptrdiff_t>(modes.size()) / count, modes.size() / count, values);
    check(VecRestoreArrayWrite(v, &values));
    PetscReal before = 0, after = 0;
    check(VecNorm(v, NORM_2, &before));
    for (int pass = 0; pass < 2; ++pass)
      for (const OwnedVec& q : basis) {
        PetscScalar part = 0;
        check(VecDot(v, q, &part));
        check(VecAXPY(v, -part, q));
      }
    check(VecNormalize(v, &after));
    if (after > kDependent * before) basis.push_back(std::move(v));
  }
  if (basis.empty()) return;
  const std::vector<Vec> plain(basis.begin(), basis.end());
  Owned<MatNullSpace, MatNullSpaceDestroy> space;
  check(MatNullSpaceCreate(ranks_of(finest).comm(), PETSC_FALSE, static_cast<PetscInt>(plain.size()), plain.data(), space.put()));
  check(MatSetNearNullSpace(finest, space));
}

/// All entries of a symmetric matrix, in arrays that PETSc uses, and which must outlive what uses the matrix: a copy would raise the peak of memory.
struct Whole {
  explicit Whole(const HalfMatrix& of) : own(of.full()), matrix(matrix_of(of.ranks(), own, others, of.rows(), {of.block(), of.block()})) {}
  Rows own, others;
  OwnedMat matrix;
};

/// The stiffness of displacements, definite also where nothing holds a body.
Whole held_slightly(const HalfMatrix& of) {
  constexpr double kSlightly = 1e-8;
  Whole whole(of);
  OwnedVec diagonal;
  check(MatCreateVecs(whole.matrix, diagonal.put(), nullptr));
  check(MatGetDiagonal(whole.matrix, diagonal));
  check(VecScale(diagonal, kSlightly));
  check(MatDiagonalSet(whole.matrix, diagonal, ADD_VALUES));
  return whole;
}

/// S P, with the blocks of P.
OwnedMat product(Mat S, Mat P) {
  OwnedMat m;
  check(MatMatMult(S, P, MAT_INITIAL_MATRIX, PETSC_DEFAULT, m.put()));
  check(MatProductClear(m));
  const BlockSize size(P);
  check(MatSetBlockSizes(m, size.rows, size.columns));
  return m;
}

}  // namespace

Hierarchy::Hierarchy(const Ranks& ranks, Piece piece) : ranks_(ranks), piece_(std::move(piece)) {
  empty_.assign(static_cast<std::size_t>(piece_.own[0]), 0);
  if (piece_.lent) matrices_.emplace_back(piece_.lent, &piece_.lent->now());
  else add_level(HalfMatrix(ranks_, std::move(piece_.matrix)));
  changed_.emplace_back(empty_.size(), 1);
  make_room_for(piece_.beside);
  coarsen();
}

OwnedMat Hierarchy::oblong(Rows& rows, int own_columns, std::array<int, 2> blocks) {
  return matrix_of(ranks_, rows, others_.emplace_back(), own_columns, blocks);
}

bool Hierarchy::aggregates() {
  return piece_.shared_levels == 0 && (meshes() == 0 || aggregates_follow(ranks_.sum(piece_.own.back()), ranks_.sum(piece_.own[0])));
}

int Hierarchy::shared_meshes() {
  constexpr double kMost = 10'000;  // unknowns of a level that many ranks have whole, too
  if (ranks_.alone()) return meshes();
  int count = 1;
  while (count < meshes() && ranks_.sum(piece_.own[count]) > std::min(kMost, kFewestUnknowns * ranks_.count())) ++count;
  return count;
}

Piece Hierarchy::last_for_all() {
  Piece piece;
  piece.shared_levels = levels();
  piece.block = piece.dimension = matrices_.back()->block();
  piece.matrix = all_rows(ranks_, matrices_.back()->stored());
  piece.own = {piece.matrix.nodes() * piece.block};
  auto functions = std::make_shared<std::vector<OwnFunctions>>();
  for (int l = levels() - 1; l < meshes(); ++l) {
    functions->push_back(all_rows(ranks_, (*piece_.functions)[l]));
    piece.own.push_back(static_cast<int>(ranks_.sum(piece_.own[l + 1])));
  }
  piece.functions = functions;
  return piece;
}

void Hierarchy::coarsen() {
  const bool same = piece_.unknowns.columns.empty();
  OwnedMat S;
  if (!ranks_.all(same)) S = oblong(piece_.unknowns, piece_.own[0], {piece_.block, piece_.block});
  if (meshes() > 0 || piece_.shared_levels > 0) {
    take(piece_.beside);
    const bool end_in_aggregates = aggregates();
    take_functions(S, end_in_aggregates ? meshes() : shared_meshes());
    if (piece_.coarser) compute_coarser();
    take(piece_.first);
    if (end_in_aggregates) {
      fill_coarse();
      forget_changes();
      take_aggregates(Whole(*matrices_.back()).matrix);
    }
  } else if (S) {
    take_aggregates((piece_.slices ? held_slightly(matrix(0)) : held_slightly(HalfMatrix(ranks_, std::move(piece_.displaced)))).matrix);
    take(piece_.beside), take(piece_.first);
    take_unknowns(S);
  } else {
    take(piece_.beside), take(piece_.first);
    take_aggregates(Whole(matrix(0)).matrix);
  }
  S = OwnedMat();
  piece_.unknowns = Rows(), piece_.beside = Change(), piece_.first = Change();
  for (std::size_t l = products_.size(); l < interpolations_.size(); ++l) multiply(static_cast<int>(l));
}

void Hierarchy::multiply(int level) {
  products_.emplace_back(matrix(level), interpolations_[level]);
  if (level > 0) changed_.emplace_back(static_cast<std::size_t>(matrix(level).rows()), 1);
}

void Hierarchy::take_functions(Mat S, int count) {
  for (int l = 0; l < count; ++l) {
    OwnedMat P = oblong(rows_.emplace_back((*piece_.functions)[l].rows(piece_.dimension)), piece_.own[l + 1], {l == 0 ? piece_.block : piece_.dimension, piece_.dimension});
    if (l == 0 && piece_.load && piece_.coarser) restrict_load(P);
    if (l == 0 && S) P = product(S, P);
    interpolations_.push_back(std::move(P));
    multiply(l);
    add_level(products_[l].pattern(matrix(l), interpolations_[l]));
  }
}

void Hierarchy::compute_coarser() {
  const std::vector<char> computed = products_[0].compute(matrix(0), interpolations_[0], matrix(1), changed_[0]);
  std::ranges::fill(changed_[0], 0);
  coarser_ = matrix(1).stored();
  make_definite(matrix(1), computed);
}

void Hierarchy::restrict_load(Mat P) {
  OwnedVec coarse, fine;
  check(MatCreateVecs(P, coarse.put(), fine.put()));
  std::ranges::copy(*piece_.load, static_cast<double*>(Numbers(fine)));
  check(MatMultTranspose(P, fine, coarse));
  const ReadNumbers numbers(coarse);
  coarser_load_ = std::make_shared<const std::vector<double>>(numbers + 0, numbers + piece_.own[1]);
}

void Hierarchy::take_aggregates(Mat finest) {
  check(MatSetOption(finest, MAT_SPD, PETSC_TRUE));
  attach_near_kernel(finest, piece_.modes, piece_.motions);
  std::vector<double>().swap(piece_.modes);
  const OwnedPc pc = aggregate(finest);
  PetscInt count = 0, coarse = 0;
  Mat *interpolations = nullptr, *operators = nullptr;
  check(PCGetInterpolations(pc, &count, &interpolations));  // the coarsest first, each with a reference for us
  check(PCGetCoarseOperators(pc, &coarse, &operators));
  for (PetscInt l = count - 2; l >= 0; --l) {
    interpolations_.emplace_back(interpolations[l]);
    add_level(half_of(OwnedMat(operators[l])));
  }
  check(PetscFree(interpolations));
  check(PetscFree(operators));
}

void Hierarchy::take_unknowns(Mat S) {
  if (interpolations_.empty()) return;
  interpolations_[0] = product(S, interpolations_[0]);
  for (std::size_t l = 0; l < interpolations_.size(); ++l) {  // bodies that nothing joined meet in these patterns
    multiply(static_cast<int>(l));
    *matrices_[l + 1] = products_[l].pattern(matrix(l), interpolations_[l]);
  }
}

/// Of A, rows and columns of what is held are empty, so that no other rows of coarse matrices depend on these rows of P.
void Hierarchy::truncate(const std::vector<int>& held) {
  std::vector<char> empty(empty_.size(), 0);
  for (const int row : held) empty[row] = 1;
  const LocalRows P(interpolations_[0]);
  for (int i = 0; i < P.count(); ++i) {
    if (empty[i] == empty_[i]) continue;
    changed_[0][i] = 1;
    std::vector<double>& before = emptied_[i];
    std::size_t k = 0;
    P.for_each(i, [&](int, double& value) {
      if (empty[i]) before.push_back(std::exchange(value, 0.0));
      else value = before[k++];
    });
    if (!empty[i]) emptied_.erase(i);
  }
  empty_ = empty;
}

void Hierarchy::make_room_for(const Change& change) {
  HalfMatrix& A = matrix(0);
  std::vector<std::array<int, 2>> missing;
  for (std::size_t e = 0; e < change.values.size(); ++e)
    if (!A.find(change.rows[e] - A.first_row(), change.columns[e])) missing.push_back({change.rows[e] / A.block(), change.columns[e] / A.block()});
  if (!ranks_.all(missing.empty())) A = HalfMatrix(ranks_, widened(A.stored(), missing));
}

bool Hierarchy::take(const Change& change) {
  bool positive = true;
  HalfMatrix& A = matrix(0);
  std::vector<LentMatrix::Number> numbers;
  for (std::size_t e = 0; e < change.values.size(); ++e) {
    const int row = change.rows[e] - A.first_row();
    double* number = A.find(row, change.columns[e]);
    if (!number) throw std::runtime_error("multigrid: the matrix has another pattern than the one that the solver was made for");
    if (change.rows[e] == change.columns[e] && !(change.values[e] > 0)) positive = false;
    if (*number == change.values[e]) continue;
    numbers.emplace_back(number, change.values[e]);
    changed_[0][row] = 1;
    if (A.has(change.columns[e])) changed_[0][change.columns[e] - A.first_row()] = 1;
  }
  if (piece_.lent) piece_.lent->change(std::move(numbers));
  else for (const auto& [place, number] : numbers) *place = number;
  return positive;
}

bool Hierarchy::set(const Change& change) {
  if (!ranks_.all(take(change))) return false;
  if (!interpolations_.empty()) {
    truncate(change.empty);
    tell_changed(interpolations_[0]);
    products_[0].fetch(interpolations_[0]);
  }
  fill_coarse();
  return true;
}

void Hierarchy::set(const AllNumbers& numbers) {
  matrix(0).take(numbers.below, numbers.diagonal, changed_[0]);
  fill_coarse();
}

void Hierarchy::fill_coarse() {
  for (std::size_t l = 0; l < products_.size(); ++l) {
    const std::vector<char> computed = products_[l].compute(matrix(l), interpolations_[l], matrix(l + 1), changed_[l]);
    make_definite(matrix(l + 1), computed);
    for (std::size_t i = 0; l + 1 < products_.size() && i < computed.size(); ++i) changed_[l + 1][i] |= computed[i];
  }
}

void Hierarchy::forget_changes() {
  for (std::vector<char>& rows : changed_) std::ranges::fill(rows, 0);
}

double Hierarchy::bytes() const {
  double sum = matrices_[0]->bytes();
  for (std::size_t l = 1; l < matrices_.size(); ++l) sum += matrices_[l]->bytes() + bytes_of(interpolations_[l - 1]) + products_[l - 1].bytes();
  return sum;
}

}  // namespace dotyk::multigrid

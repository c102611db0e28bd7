#include "multigrid/cycle.hpp"
#include "multigrid/damping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dotyk::multigrid {

namespace {

constexpr int kMostIterations = 1000;
/// After so many iterations their rate of convergence is trusted to foretell how many there will be.
constexpr int kTelling = 10;

struct Ending {
  double first, residual;  // residuals: the first one, and at which to end
  double most;             // iterations that are worth while; those made already are spent either way
  Monitor* monitor;
  const Ranks& ranks;
  std::exception_ptr thrown = nullptr;  // by the monitor, kept until PETSc has returned

  /// Whether rank 0's monitor wants the end: all ranks learn it.
  bool stopped() {
    int stop = 0;
    try {
      if (monitor) monitor->check();
    } catch (...) {
      thrown = std::current_exception();
      stop = 1;
    }
    if (!ranks.alone()) MPI_Bcast(&stop, 1, MPI_INT, 0, ranks.comm());
    return stop != 0;
  }
};

/// How many iterations twelve digits take in all at the rate so far. The first systems of a Newton iteration are solved to fewer, the last one to as many.
double foreseen(const Ending& ending, int iteration, double residual) {
  return residual < ending.first ? iteration * std::log(1e-12) / std::log(residual / ending.first) : INFINITY;
}

PetscErrorCode ended(KSP, PetscInt iteration, PetscReal residual, KSPConvergedReason* reason, void* context) {
  Ending& ending = *static_cast<Ending*>(context);
  *reason = !std::isfinite(residual)         ? KSP_DIVERGED_NANORINF
            : residual <= ending.residual    ? KSP_CONVERGED_RTOL
            : iteration >= kMostIterations   ? KSP_DIVERGED_ITS
            : iteration >= kTelling && foreseen(ending, iteration, residual) - iteration > ending.most ? KSP_DIVERGED_ITS
                                             : KSP_CONVERGED_ITERATING;
  if (*reason == KSP_CONVERGED_ITERATING && ending.stopped()) *reason = KSP_DIVERGED_BREAKDOWN;
  return 0;
}

}  // namespace

Cycle::Cycle(const Ranks& ranks, Piece piece, const Change& first) : ranks_(ranks), hierarchy_(ranks, std::move(piece), first) {
  check(MatCreateVecs(hierarchy_.matrix(0), x_.put(), b_.put()));
  make();
}

void Cycle::make() {
  const int twice = first_swept_twice();
  for (int l = 0; l + 1 < levels(); ++l) {
    Level& level = all_.emplace_back(Level{Sweeps(hierarchy_.matrix(l)), l >= twice ? 2 : 1, {}, {}, {}, {}});
    check(MatCreateVecs(hierarchy_.matrix(l), level.left.put(), level.change.put()));
    check(MatCreateVecs(hierarchy_.matrix(l + 1), level.coarse.put(), level.correction.put()));
  }
  check(KSPCreate(ranks_.comm(), coarsest_.put()));
  constexpr PetscInt kSmall = 2000;  // for PETSc's own factor, which takes singular matrices, and empty ones
  const Mat coarsest = hierarchy_.matrix(levels() - 1);
  PetscInt size = 0;
  check(MatGetSize(coarsest, &size, nullptr));
  if (size <= kSmall) factor_on_each(coarsest_, coarsest, MAT_SHIFT_POSITIVE_DEFINITE, MATSOLVERPETSC);
  else factor_on_each(coarsest_, coarsest, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  check(KSPCreate(ranks_.comm(), ksp_.put()));
  check(KSPSetType(ksp_, KSPCG));
  check(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, this));
  check(PCShellSetApply(pc, precondition));
}

PetscErrorCode Cycle::precondition(PC shell, Vec b, Vec x) {
  void* self = nullptr;
  PetscCall(PCShellGetContext(shell, &self));
  try {
    static_cast<Cycle*>(self)->descend(0, b, x);
  } catch (const std::exception& error) {
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  return 0;
}

void Cycle::descend(std::size_t l, Vec b, Vec x) {
  if (l == all_.size()) return check(KSPSolve(coarsest_, b, x));
  Level& level = all_[l];
  const Mat A = hierarchy_.matrix(static_cast<int>(l)), P = hierarchy_.interpolation(static_cast<int>(l));
  const bool solved = l == 0 && shared_.any();
  level.sweeps.forward(b, x, level.left);
  for (int k = 1; k < level.count; ++k) {
    level.sweeps.forward(level.left, level.change, level.left);
    check(VecAXPY(x, 1, level.change));
  }
  if (solved) {
    shared_.solve(b, x);
    check(MatResidual(A, b, x, level.left));
  }
  check(MatMultTranspose(P, level.left, level.coarse));
  descend(l + 1, level.coarse, level.correction);
  check(MatMultAdd(P, level.correction, x, x));
  if (solved) shared_.solve(b, x);
  for (int k = 0; k < level.count; ++k) level.sweeps.backward(b, x);
}

/// A second sweep costs little where a level has few unknowns. On the second coarser mesh and below (1/64 of the unknowns) it saves a tenth of the
/// iterations with friction: 28 instead of 31 on a cube of 64³ cells. Where aggregates follow the coarsest mesh, they converge more slowly than meshes, and a
/// second sweep from that mesh on saves a fifth: 22 instead of 27 on 76³ cells, with aggregates below 19³. During a sweep a rank uses the values that other
/// ranks had before it. Where each rank has few unknowns, most of them are coupled to other ranks, and the second sweep begins one level earlier.
int Cycle::first_swept_twice() const {
  constexpr PetscInt kFew = 20'000;  // unknowns of a rank
  if (hierarchy_.meshes() == 0) return levels();  // none: aggregates alone
  if (ranks_.alone()) return std::min(hierarchy_.meshes(), 2);
  PetscInt unknowns = 0;
  check(MatGetSize(hierarchy_.matrix(1), &unknowns, nullptr));
  return std::min(hierarchy_.meshes(), unknowns < kFew * ranks_.count() ? 1 : 2);
}

bool Cycle::set(const Change& change) {
  if (!hierarchy_.set(change)) return false;
  double of_sweeps = 0;
  for (std::size_t l = 0; l < all_.size(); ++l) {
    const Mat A = hierarchy_.matrix(static_cast<int>(l));
    all_[l].sweeps.set(A, damping(A, l == 0 ? change.shared : std::vector<int>()));
    of_sweeps += all_[l].sweeps.bytes();
  }
  if (!ranks_.all(shared_.set(hierarchy_.matrix(0), change.shared))) return false;
  check(KSPSetOperators(ksp_, hierarchy_.matrix(0), hierarchy_.matrix(0)));
  const Mat coarsest = hierarchy_.matrix(levels() - 1);
  check(KSPSetOperators(coarsest_, coarsest, coarsest));
  if (!ranks_.all(set_up(coarsest_))) return false;
  bytes_ = ranks_.sum(hierarchy_.bytes() + of_sweeps);
  return true;
}

Cycle::Solution Cycle::solve(const std::vector<double>& b, double tolerance, double most, Monitor* monitor) {
  PetscScalar* in = nullptr;
  check(VecGetArrayWrite(b_, &in));
  std::copy(b.begin(), b.end(), in);
  check(VecRestoreArrayWrite(b_, &in));
  PetscReal norm = 0;
  check(VecNorm(b_, NORM_2, &norm));
  Ending ending{norm, tolerance * norm, most, monitor, ranks_};
  check(KSPSetConvergenceTest(ksp_, ended, &ending, nullptr));
  check(KSPSolve(ksp_, b_, x_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  Solution solution;
  check(KSPGetConvergedReason(ksp_, &reason));
  check(KSPGetIterationNumber(ksp_, &solution.iterations));
  solution.thrown = ending.thrown;
  solution.found = reason > 0;
  const auto numbers = [&](Vec of) {
    const PetscScalar* out = nullptr;
    check(VecGetArrayRead(of, &out));
    const std::vector<double> own(out, out + b.size());
    check(VecRestoreArrayRead(of, &out));
    return own;
  };
  solution.x = numbers(x_);
  Vec left = nullptr;
  check(KSPBuildResidual(ksp_, x_, b_, &left));  // for CG a copy of what it carries along, into b_, which is not needed any more
  solution.left = numbers(left);
  return solution;
}

}  // namespace dotyk::multigrid

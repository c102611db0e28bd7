#include "multigrid/cycle.hpp"

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
  make();
}

void Cycle::make() {
  const int twice = first_swept_twice();
  for (int l = 0; l + 1 < levels(); ++l) {
    Level& level = all_.emplace_back(Level{Sweeps(hierarchy_.matrix(l)), l >= twice ? 2 : 1, {}, {}, {}, {}});
    check(MatCreateVecs(hierarchy_.interpolation(l), level.coarse.put(), level.left.put()));
    check(VecDuplicate(level.coarse, level.correction.put()));
    check(VecDuplicate(level.left, level.change.put()));
  }
  check(KSPCreate(ranks_.comm(), coarsest_.put()));
  constexpr double kSmall = 2000;  // for PETSc's own factor, which takes singular matrices, and empty ones
  const HalfMatrix& coarsest = hierarchy_.matrix(levels() - 1);
  last_ = copied(ranks_, coarsest.full(), coarsest.rows());
  if (ranks_.sum(coarsest.rows()) <= kSmall) factor_on_each(coarsest_, last_, MAT_SHIFT_POSITIVE_DEFINITE, MATSOLVERPETSC);
  else factor_on_each(coarsest_, last_, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  const int own = hierarchy_.matrix(0).rows();
  check(MatCreateShell(ranks_.comm(), own, own, PETSC_DETERMINE, PETSC_DETERMINE, this, finest_.put()));
  check(MatShellSetOperation(finest_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  check(MatCreateVecs(finest_, x_.put(), b_.put()));
  check(KSPCreate(ranks_.comm(), ksp_.put()));
  check(KSPSetOperators(ksp_, finest_, finest_));
  check(KSPSetType(ksp_, KSPCG));
  check(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, this));
  check(PCShellSetApply(pc, precondition));
}

namespace {

/// Calls work for PETSc, which knows no exceptions.
template <class Work>
PetscErrorCode called_by_petsc(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  return 0;
}

}  // namespace

PetscErrorCode Cycle::multiply(Mat shell, Vec x, Vec y) {
  void* self = nullptr;
  PetscCall(MatShellGetContext(shell, &self));
  return called_by_petsc([&] { static_cast<Cycle*>(self)->hierarchy_.matrix(0).times(ReadNumbers(x), Numbers(y)); });
}

PetscErrorCode Cycle::precondition(PC shell, Vec b, Vec x) {
  void* self = nullptr;
  PetscCall(PCShellGetContext(shell, &self));
  return called_by_petsc([&] { static_cast<Cycle*>(self)->descend(0, b, x); });
}

void Cycle::descend(std::size_t l, Vec b, Vec x) {
  if (l == all_.size()) return check(KSPSolve(coarsest_, b, x));
  Level& level = all_[l];
  const Mat P = hierarchy_.interpolation(static_cast<int>(l));
  const bool solved = l == 0 && shared_.any();
  level.sweeps.forward(ReadNumbers(b), Numbers(x), Numbers(level.left));
  for (int k = 1; k < level.count; ++k) {
    {
      Numbers left(level.left);
      level.sweeps.forward(left, Numbers(level.change), left);
    }
    check(VecAXPY(x, 1, level.change));
  }
  if (solved) {
    shared_.solve(b, x);
    hierarchy_.matrix(0).times(ReadNumbers(x), Numbers(level.left));
    check(VecAYPX(level.left, -1, b));
  }
  check(MatMultTranspose(P, level.left, level.coarse));
  descend(l + 1, level.coarse, level.correction);
  check(MatMultAdd(P, level.correction, x, x));
  if (solved) shared_.solve(b, x);
  for (int k = 0; k < level.count; ++k) level.sweeps.backward(ReadNumbers(b), Numbers(x));
}

/// A second sweep costs little where a level has few unknowns. On the second coarser mesh and below (1/64 of the unknowns) it saves a tenth of the
/// iterations with friction: 28 instead of 31 on a cube of 64³ cells. Where aggregates follow the coarsest mesh, they converge more slowly than meshes, and a
/// second sweep from that mesh on saves a fifth: 22 instead of 27 on 76³ cells, with aggregates below 19³.
int Cycle::first_swept_twice() const { return hierarchy_.meshes() == 0 ? levels() : std::min(hierarchy_.meshes(), 2); }

void Cycle::take_coarsest() {
  HalfMatrix& coarsest = hierarchy_.matrix(levels() - 1);
  {
    const LocalRows rows(last_);
    for (int row = 0; row < rows.count(); ++row) rows.for_each(row, [&](int column, double& number) { number = *coarsest.find(row, column); });
  }
  tell_changed(last_);
}

bool Cycle::set(const Change& change) {
  if (!hierarchy_.set(change)) return false;
  double of_sweeps = 0;
  for (std::size_t l = 0; l < all_.size(); ++l) {
    all_[l].sweeps.set(damping(hierarchy_.matrix(static_cast<int>(l)), l == 0 ? change.shared : std::vector<int>()));
    of_sweeps += all_[l].sweeps.bytes();
  }
  if (!ranks_.all(shared_.set(hierarchy_.matrix(0), change.shared))) return false;
  take_coarsest();
  if (!ranks_.all(set_up(coarsest_))) return false;
  bytes_ = ranks_.sum(hierarchy_.bytes() + of_sweeps);
  return true;
}

Cycle::Solution Cycle::solve(const std::vector<double>& b, double tolerance, double most, Monitor* monitor) {
  std::copy(b.begin(), b.end(), static_cast<double*>(Numbers(b_)));
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
    const ReadNumbers own(of);
    return std::vector<double>(own + 0, own + b.size());
  };
  solution.x = numbers(x_);
  Vec left = nullptr;
  check(KSPBuildResidual(ksp_, x_, b_, &left));  // for CG a copy of what it carries along, into b_, which is not needed any more
  solution.left = numbers(left);
  return solution;
}

}  // namespace dotyk::multigrid

// Conjugate gradients with a V-cycle over a hierarchy, and the door of the library. PETSc knows no threads, so one call at a time goes
// through. No exception passes through functions of PETSc.
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>

#include "base/text.hpp"
#include "multigrid/finest_smoother.hpp"
#include "multigrid/hierarchy.hpp"

namespace dotyk::multigrid {

namespace {

constexpr int kMostIterations = 1000;
/// After so many iterations their rate of convergence is trusted to foretell how many there will be.
constexpr int kTelling = 10;

std::mutex& only_one() {
  static std::mutex mutex;
  return mutex;
}

/// One sweep of Gauss and Seidel, `type` its direction: forward before the coarse correction and backward after it make the cycle
/// symmetric.
void make_smoother(KSP ksp, Mat matrix, MatSORType type) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPRICHARDSON));
  check(KSPSetNormType(ksp, KSP_NORM_NONE));
  check(KSPSetTolerances(ksp, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 1));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCSOR));
  check(PCSORSetSymmetric(pc, type));
}

void make_coarsest(KSP ksp, Mat matrix) {
  PC pc = nullptr;
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPPREONLY));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetShiftType(pc, MAT_SHIFT_POSITIVE_DEFINITE));
}

struct Ending {
  double first, residual;  // residuals: the first one, and at which to end
  double most;             // iterations
  Monitor& monitor;
  std::exception_ptr thrown = nullptr;  // by the monitor, kept until PETSc has returned
};

/// How many iterations twelve digits take at the rate so far. The first systems of a Newton iteration are solved to fewer, the last one to as many.
double foreseen(const Ending& ending, int iteration, double residual) {
  return residual < ending.first ? iteration * std::log(1e-12) / std::log(residual / ending.first) : INFINITY;
}

PetscErrorCode ended(KSP, PetscInt iteration, PetscReal residual, KSPConvergedReason* reason, void* context) {
  Ending& ending = *static_cast<Ending*>(context);
  *reason = !std::isfinite(residual)         ? KSP_DIVERGED_NANORINF
            : residual <= ending.residual    ? KSP_CONVERGED_RTOL
            : iteration >= kMostIterations   ? KSP_DIVERGED_ITS
            : iteration >= kTelling && foreseen(ending, iteration, residual) > ending.most ? KSP_DIVERGED_ITS
                                             : KSP_CONVERGED_ITERATING;
  if (*reason != KSP_CONVERGED_ITERATING) return 0;
  try {
    ending.monitor.check();
  } catch (...) {
    ending.thrown = std::current_exception();
    *reason = KSP_DIVERGED_BREAKDOWN;
  }
  return 0;
}

class PetscSolver final : public algebra::SpdSolver {
 public:
  PetscSolver(const Matrix& matrix, Monitor& monitor) : monitor_(monitor), most_(matrix.most_iterations), geometric_(matrix.coarse), hierarchy_(matrix) {
    check(MatCreateVecs(hierarchy_.matrix(0), x_.put(), b_.put()));
    make_cycle();
    alone_.unlock();
  }
  ~PetscSolver() override { alone_.lock(); }

  bool set(const algebra::SparseMatrix& lower, const std::vector<char>& held) override {
    monitor_.check();
    const std::lock_guard lock(only_one());
    if (!hierarchy_.set(lower, held)) return false;
    if (!finest_.set(hierarchy_.matrix(0), hierarchy_.shared())) return false;
    check(KSPSetOperators(ksp_, hierarchy_.matrix(0), hierarchy_.matrix(0)));
    check(KSPSetUp(ksp_));
    return true;
  }

  algebra::Vector solve(const algebra::Vector& b, double tolerance) override {
    const std::vector<int>& slot = hierarchy_.embedding().slot();
    algebra::Vector x = algebra::Vector::Constant(static_cast<Eigen::Index>(slot.size()), std::numeric_limits<double>::quiet_NaN());
    if (b.size() != x.size()) throw std::runtime_error(text("a right-hand side of ", b.size(), " numbers for ", x.size(), " unknowns"));
    const std::lock_guard lock(only_one());
    check(VecSet(b_, 0.0));
    PetscScalar* in = nullptr;
    check(VecGetArray(b_, &in));
    for (std::size_t i = 0; i < slot.size(); ++i) in[slot[i]] = b[static_cast<Eigen::Index>(i)];
    check(VecRestoreArray(b_, &in));
    PetscReal norm = 0;
    check(VecNorm(b_, NORM_2, &norm));
    Ending ending{norm, tolerance * norm, most_, monitor_};
    check(KSPSetConvergenceTest(ksp_, ended, &ending, nullptr));
    check(KSPSolve(ksp_, b_, x_));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    check(KSPGetConvergedReason(ksp_, &reason));
    check(KSPGetIterationNumber(ksp_, &iterations));
    iterations_ += iterations;
    if (ending.thrown) std::rethrow_exception(ending.thrown);
    if (reason <= 0) return x;
    const PetscScalar* out = nullptr;
    check(VecGetArrayRead(x_, &out));
    for (std::size_t i = 0; i < slot.size(); ++i) x[static_cast<Eigen::Index>(i)] = out[slot[i]];
    check(VecRestoreArrayRead(x_, &out));
    return x;
  }

  double bytes() const override {
    const std::lock_guard lock(only_one());
    return hierarchy_.bytes();
  }
  int iterations() const override { return iterations_; }
  int levels() const override { return hierarchy_.levels(); }
  std::string method() const override {
    return text("conjugate gradients, ", geometric_ ? "geometric" : "algebraic", " multigrid (PETSc ", PETSC_VERSION_MAJOR, ".", PETSC_VERSION_MINOR, ", ", levels(),
                levels() == 1 ? " level)" : " levels)");
  }

 private:
  void make_cycle() {
    check(KSPCreate(PETSC_COMM_SELF, ksp_.put()));
    check(KSPSetOperators(ksp_, hierarchy_.matrix(0), hierarchy_.matrix(0)));
    check(KSPSetType(ksp_, KSPCG));
    check(KSPSetNormType(ksp_, KSP_NORM_UNPRECONDITIONED));
    PC pc = nullptr;
    check(KSPGetPC(ksp_, &pc));
    check(PCSetType(pc, PCMG));
    check(PCMGSetLevels(pc, levels(), nullptr));
    check(PCMGSetGalerkin(pc, PC_MG_GALERKIN_EXTERNAL));
    KSP ksp = nullptr;
    for (int l = 0; l + 1 < levels(); ++l) {
      const int theirs = levels() - 1 - l;  // PETSc counts from the coarsest
      check(PCMGSetInterpolation(pc, theirs, hierarchy_.interpolation(l)));
      check(PCMGGetSmootherDown(pc, theirs, &ksp));
      make_smoother(ksp, hierarchy_.matrix(l), SOR_LOCAL_FORWARD_SWEEP);
      if (l == 0) finest_.attach(ksp, true);
      check(PCMGGetSmootherUp(pc, theirs, &ksp));
      make_smoother(ksp, hierarchy_.matrix(l), SOR_LOCAL_BACKWARD_SWEEP);
      if (l == 0) finest_.attach(ksp, false);
      check(KSPSetInitialGuessNonzero(ksp, PETSC_TRUE));
    }
    check(PCMGGetCoarseSolve(pc, &ksp));
    make_coarsest(ksp, hierarchy_.matrix(levels() - 1));
  }

  std::unique_lock<std::mutex> alone_{only_one()};  // while the members after it are made, and while they are destroyed
  Monitor& monitor_;
  const double most_;  // iterations
  const bool geometric_;
  Hierarchy hierarchy_;
  FinestSmoother finest_;
  OwnedKsp ksp_;
  OwnedVec b_, x_;
  int iterations_ = 0;
};

}  // namespace

}  // namespace dotyk::multigrid

extern "C" __attribute__((visibility("default"))) dotyk::algebra::SpdSolver* dotyk_multigrid_solver(const dotyk::multigrid::Matrix& matrix,
                                                                                                   dotyk::Monitor& monitor) {
  dotyk::multigrid::start_petsc();
  monitor.check();
  auto solver = std::make_unique<dotyk::multigrid::PetscSolver>(matrix, monitor);
  monitor.check();
  return solver.release();
}

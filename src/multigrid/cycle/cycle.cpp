#include "multigrid/cycle/cycle.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dotyk::multigrid {

namespace {

constexpr int kMostIterations = 1000;
/// After so many iterations their rate of convergence is trusted to foretell how many there will be.
constexpr int kTelling = 10;

/// How many iterations twelve digits take in all at the rate so far. The first systems of a Newton iteration are solved to fewer, the last one to as many.
double foreseen(double first, double residual, int iterations) {
  return residual < first ? iterations * std::log(1e-12) / std::log(residual / first) : INFINITY;
}

double norm(Vec v) {
  PetscReal size = 0;
  check(VecNorm(v, NORM_2, &size));
  return size;
}

/// This rank's part of a · b.
double dot(Vec a, Vec b) {
  PetscInt count = 0;
  check(VecGetLocalSize(a, &count));
  const ReadNumbers of_a(a), of_b(b);
  return Eigen::VectorXd::Map(of_a, count).dot(Eigen::VectorXd::Map(of_b, count));
}

/// Does the monitor throw? Then the solution keeps what it has thrown.
bool asked_to_end(Monitor* monitor, Cycle::Solution& solution) {
  try {
    if (monitor) monitor->check();
    return false;
  } catch (...) {
    solution.thrown = std::current_exception();
    return true;
  }
}

}  // namespace

Cycle::Cycle(const Ranks& ranks, Piece piece) : ranks_(ranks), hierarchy_(ranks, std::move(piece)) {
  const int twice = first_swept_twice();
  for (int l = 0; l + 1 < hierarchy_.levels(); ++l) {
    Level& level = levels_.emplace_back(Level{Sweeps(hierarchy_.matrix(l)), l >= twice ? 2 : 1, {}, {}, {}, {}});
    check(MatCreateVecs(hierarchy_.interpolation(l), level.coarse.put(), level.left.put()));
    check(VecDuplicate(level.coarse, level.correction.put()));
    check(VecDuplicate(level.left, level.change.put()));
  }
  const HalfMatrix& last = hierarchy_.matrix(hierarchy_.levels() - 1);
  if (ranks_.alone()) {
    constexpr double kSmall = 2000;  // for PETSc's own factor, which takes singular matrices, and empty ones
    check(KSPCreate(ranks_.comm(), coarsest_.put()));
    last_ = copied(ranks_, last.full(), last.rows());
    if (last.rows() <= kSmall) factor_on_each(coarsest_, last_, MAT_SHIFT_POSITIVE_DEFINITE, MATSOLVERPETSC);
    else factor_on_each(coarsest_, last_, MAT_SHIFT_NONE, MATSOLVERCHOLMOD);
  } else {
    counts_ = ranks_.gather(last.rows());
    whole_ = std::make_unique<Cycle>(Ranks(MPI_COMM_SELF), hierarchy_.last_for_all());
  }
  const int own = hierarchy_.matrix(0).rows();
  check(VecCreate(ranks_.comm(), x_.put()));
  check(VecSetSizes(x_, own, PETSC_DETERMINE));
  check(VecSetType(x_, VECSTANDARD));
  for (OwnedVec* v : {&left_, &z_, &p_, &Ap_}) check(VecDuplicate(x_, v->put()));
}

void Cycle::solve_last(Vec b, Vec x) {
  if (!whole_) return check(KSPSolve(coarsest_, b, x));
  ranks_.gather(ReadNumbers(b), counts_, Numbers(whole_->left_));
  whole_->descend(0, whole_->left_, whole_->z_);
  const ReadNumbers all(whole_->z_);
  const HalfMatrix& last = hierarchy_.matrix(hierarchy_.levels() - 1);
  std::copy_n(all + last.first_row(), last.rows(), static_cast<double*>(Numbers(x)));
}

void Cycle::descend(std::size_t l, Vec b, Vec x) {
  if (l == levels_.size()) return solve_last(b, x);
  Level& level = levels_[l];
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

/// A second sweep costs little where a level has few unknowns. Measured with PETSc's sweeps: on the second coarser mesh and below (1/64 of the unknowns) it
/// saves a tenth of the iterations with friction, 28 instead of 31 on a cube of 64³ cells. Where aggregates follow the coarsest mesh, they converge more
/// slowly than meshes, and a second sweep from that mesh on saves a fifth: 22 instead of 27 on 76³ cells, with aggregates below 19³.
int Cycle::first_swept_twice() const {
  const int finer = hierarchy_.finer(), meshes = finer + hierarchy_.meshes();
  return meshes == 0 ? hierarchy_.levels() : std::min(meshes, 2) - finer;
}

bool Cycle::take_last() {
  HalfMatrix& last = hierarchy_.matrix(hierarchy_.levels() - 1);
  if (whole_) return whole_->set(all_numbers(ranks_, last.stored()));
  {
    const LocalRows rows(last_);
    for (int row = 0; row < rows.count(); ++row) rows.for_each(row, [&](int column, double& number) { number = *last.find(row, column); });
  }
  tell_changed(last_);
  return set_up(coarsest_);
}

bool Cycle::take_levels(const std::vector<int>& shared) {
  double of_sweeps = 0;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].sweeps.set(hierarchy_.changed(static_cast<int>(l)), l == 0 ? shared : std::vector<int>());
    of_sweeps += levels_[l].sweeps.bytes();
  }
  hierarchy_.forget_changes();
  if (!ranks_.all(shared_.set(hierarchy_.matrix(0), shared))) return false;
  if (!ranks_.all(take_last())) return false;
  bytes_ = ranks_.sum(hierarchy_.bytes() + of_sweeps + (whole_ ? whole_->bytes_ : 0));
  return true;
}

bool Cycle::set(const AllNumbers& numbers) {
  hierarchy_.set(numbers);
  return take_levels({});
}

void Cycle::interpolate(const std::vector<double>& coarse, std::vector<double>& fine) {
  const Level& level = levels_.front();
  std::ranges::copy(coarse, static_cast<double*>(Numbers(level.coarse)));
  check(MatMult(hierarchy_.interpolation(0), level.coarse, level.left));
  const ReadNumbers of_left(level.left);
  std::copy_n(of_left + 0, fine.size(), fine.begin());
}

Cycle::Solution Cycle::solve(const std::vector<double>& b, double tolerance, double most, Monitor* monitor, std::vector<double>& x, std::vector<double>& left) {
  std::copy(b.begin(), b.end(), static_cast<double*>(Numbers(left_)));
  check(VecSet(x_, 0));
  Solution solution;
  const double first = norm(left_);
  double residual = first, before = 1;
  while (residual > tolerance * first) {
    const int count = solution.iterations;
    if (count >= kMostIterations || (count >= kTelling && foreseen(first, residual, count) - count > most)) break;
    descend(0, left_, z_);
    const auto [product, ending] = ranks_.sum({dot(left_, z_), asked_to_end(monitor, solution) ? 1.0 : 0.0});
    if (ending > 0) break;
    check(count == 0 ? VecCopy(z_, p_) : VecAYPX(p_, product / before, z_));
    hierarchy_.matrix(0).times(ReadNumbers(p_), Numbers(Ap_));
    const double curvature = ranks_.sum(dot(p_, Ap_));
    if (!(product > 0 && curvature > 0)) break;  // not definite
    const double step = product / curvature;
    check(VecAXPY(x_, step, p_));
    check(VecAXPY(left_, -step, Ap_));
    before = product, residual = norm(left_), ++solution.iterations;
  }
  solution.found = residual <= tolerance * first;
  const std::size_t count = b.size();
  const ReadNumbers of_x(x_), of_left(left_);
  x.assign(of_x + 0, of_x + count), left.assign(of_left + 0, of_left + count);
  return solution;
}

}  // namespace dotyk::multigrid

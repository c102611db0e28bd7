#include "solver/active/held_stiffness.hpp"

#include "algebra/congruent.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "algebra/dense/null_space.hpp"
#include "algebra/symmetric_matrix.hpp"
#include "problem/coarser.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Field;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::StoredMatrix;
using algebra::Vector;
using problem::Problem;
using problem::RigidMotions;

namespace {

/// Where the entry is among the numbers of a compressed matrix; -1 where its pattern has none.
std::ptrdiff_t place_of(const SparseMatrix& matrix, int row, int column) {
  const int *begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column], *end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
  const int* at = std::lower_bound(begin, end, row);
  return at == end || *at != row ? -1 : at - matrix.innerIndexPtr();
}

bool has_room(const SparseMatrix& matrix, const algebra::Triplets& entries) {
  return matrix.isCompressed() && std::ranges::all_of(entries, [&](const auto& e) { return place_of(matrix, e.row(), e.col()) >= 0; });
}

}  // namespace

HeldStiffness::HeldStiffness(const Problem& problem, const RigidMotions& rigid, const MakeSpdSolver& make, Monitor& monitor, algebra::SymmetricMatrix* coarser)
    : problem_(problem), basis_(problem::row_basis(problem)), unnoticed_(problem::unnoticed_displacements(problem, rigid)), rows_(basis_.times(problem.B)),
      fixing_(algebra::fixing_unknowns(unnoticed_)) {
  if (unnoticed_.cols() > 0 && problem.hides())
    throw InputError("nothing notices " + problem::describe(rigid.motions, rigid.unnoticed.col(0)) + ": with refine on several ranks a support or a contact must. Hold it, or leave out 'refine'");
  rows_.prune([](auto, auto, double value) { return std::abs(value) > 1e-14; });
  fix_noticed(rigid);
  const algebra::Triplets beside = assemble(make.takes_slices);
  held_.assign(problem.unknowns(), 0);
  watch();
  take_near_rows();
  for (const int unknown : fixing_) change(unknown, unknown, lower().coeff(unknown, unknown));  // carries nothing
  if (rigid.noticed.cols() > 0) spring_rows(problem.row_stiffness());
  std::vector<Entry> first = now();
  solver_ = make.make({lower(), numbers(first), problem, basis_, monitor, coarser, slices_, beside, near_});
  told_ = std::move(first);
}

algebra::Triplets HeldStiffness::assemble(bool takes_slices) {
  algebra::Triplets entries;  // of rows, and of the diagonal where K has no entry there: zeros in the pattern
  for (int r = 0; r < problem_.rows(); ++r)
    for (SparseRows::InnerIterator i(rows_, r); i; ++i)
      for (SparseRows::InnerIterator j(rows_, r); j && j.col() <= i.col(); ++j) entries.emplace_back(static_cast<int>(i.col()), static_cast<int>(j.col()), 0.0);
  for (const auto& [group, k, first, n] : problem_.friction_points()) {
    const int a = basis_.unknown[first], b = basis_.unknown[first + group.components - 1];
    if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), 0.0);
  }
  if (takes_slices) slices_ = problem::slices(problem_);
  if (slices_) return assemble_near_rows(entries);
  const bool alone = problem_.blocks.size() == 1;
  for (const problem::Block& block : problem_.blocks)
    for (int j = 0; j < block.size(); ++j)
      if (!algebra::diagonal_entry(block.K.lower(), j)) entries.emplace_back(block.first + j, block.first + j, 0.0);
  lower_ = problem_.blocks.front().K;
  const bool room = alone && has_room(lower(), entries);
  if (room && basis_.trivial()) return {};
  const SparseMatrix joined = alone ? SparseMatrix() : problem::lower_stiffness(problem_);
  const SparseMatrix& K = alone ? problem_.blocks.front().K.lower() : joined;
  StoredMatrix A;
  A = basis_.of_signs() ? K : algebra::congruent(K, basis_.T);
  if (!room) A = algebra::lower_sum(A, algebra::from_triplets(problem_.unknowns(), problem_.unknowns(), entries));
  lower_ = basis_.of_signs() ? basis_.with_signs(std::move(A)) : std::move(A);
  return {};
}

/// Unknowns that are no row's mostly know of one body alone: where these feel its motions, they hold them. The motions of all others are held together.
void HeldStiffness::fix_noticed(const RigidMotions& rigid) {
  if (rigid.noticed.cols() == 0) return;
  constexpr double kFelt = 0.1;  // of what all unknowns feel
  SparseMatrix motions = problem::displacement(problem_, rigid.noticed);
  if (!basis_.trivial()) motions = SparseMatrix(basis_.of_displacements(problem_) * motions);
  std::vector<char> own(static_cast<std::size_t>(problem_.unknowns()), 0), together(static_cast<std::size_t>(motions.cols()), 1);
  for (const int unknown : basis_.unknown)
    if (unknown >= 0) own[unknown] = 1;
  SparseMatrix apart = motions;
  apart.prune([&](int row, int, double) { return !own[row]; });
  for (const algebra::Piece& piece : algebra::pieces(apart)) {
    if (piece.rows.size() < piece.columns.size()) continue;
    const DenseMatrix felt = algebra::dense(apart, piece);
    double most = 0;
    for (const int k : piece.columns) most = std::max(most, motions.col(k).norm());
    if (!(algebra::smallest_singular_value(algebra::orthogonal_factors(felt).R) > kFelt * most)) continue;
    for (const int i : algebra::fixing_unknowns(felt)) fixing_noticed_.push_back(piece.rows[i]);
    for (const int k : piece.columns) together[k] = 0;
  }
  motions.prune([&](int, int column, double) { return together[column] != 0; });
  for (const algebra::Piece& piece : algebra::pieces(motions))
    if (together[piece.columns.front()])
      for (const int i : algebra::fixing_unknowns(algebra::dense(motions, piece))) fixing_noticed_.push_back(piece.rows[i]);
}

algebra::Triplets HeldStiffness::assemble_near_rows(const algebra::Triplets& room) {
  std::vector<char> of(static_cast<std::size_t>(problem_.unknowns()), 0);
  for (Eigen::Index j = 0; j < basis_.T.cols(); ++j) {  // of other columns TᵀKT has K's entries
    const SparseMatrix::InnerIterator first(basis_.T, j);
    of[j] = first.row() != j || first.value() != 1 || basis_.T.outerIndexPtr()[j + 1] - basis_.T.outerIndexPtr()[j] > 1;
  }
  const std::vector<char> changed = of;
  for (const auto& entry : room) of[entry.row()] = of[entry.col()] = 1;
  for (const int unknown : fixing_) of[unknown] = 1;
  for (const int unknown : fixing_noticed_) of[unknown] = 1;
  StoredMatrix A = near_from_slices(of, 0);
  if (basis_.T.rows() > 0 && (basis_.T.diagonal().array() == 0).any()) {  // where an unknown does not move its own displacement, TᵀKT may be zero and K not
    StoredMatrix zeros = slices_->near(of);
    zeros.coeffs().setZero();
    A = algebra::lower_sum(A, zeros);
  }
  const bool has = has_room(A, room);
  if (!has) A = algebra::lower_sum(A, algebra::from_triplets(problem_.unknowns(), problem_.unknowns(), room));
  lower_ = std::move(A);
  algebra::Triplets beside;
  algebra::each_entry_of(lower(), changed, [&](int place, int row, int column) { beside.emplace_back(row, column, lower().valuePtr()[place]); });
  for (std::size_t k = 0; k < room.size() && !has; ++k) beside.emplace_back(room[k].row(), room[k].col(), lower().coeff(room[k].row(), room[k].col()));
  return beside;
}

StoredMatrix HeldStiffness::near_from_slices(std::vector<char>& of, int layers) const {
  if (basis_.of_signs()) return basis_.with_signs(slices_->near(of, layers));
  std::vector<char> moved = of;  // flags of displacements
  const auto each_moved = [&](auto&& visit) {
    for (Eigen::Index j = 0; j < basis_.T.cols(); ++j)
      for (SparseMatrix::InnerIterator it(basis_.T, j); it; ++it) visit(of[j], moved[it.row()]);
  };
  each_moved([](char unknown, char& displacement) { displacement |= unknown; });
  for (Eigen::Index j = 0; j < basis_.T.cols() && layers > 0; ++j)  // those that a row couples to its own unknown's
    for (SparseMatrix::InnerIterator it(basis_.T, j); it; ++it) moved[j] |= of[it.row()];
  StoredMatrix A = algebra::congruent_near(slices_->near(moved, layers), basis_.T);
  of = moved;
  each_moved([](char& unknown, char displacement) { unknown &= displacement; });
  return A;
}

algebra::SymmetricMatrix HeldStiffness::near(std::vector<char>& of, int layers) const {
  if (slices_) return near_from_slices(of, layers);
  for (; layers > 0; --layers) {
    std::vector<char> wider = of;
    algebra::each_entry_of(lower(), of, [&](int, int row, int column) { wider[row] = wider[column] = 1; });
    of = std::move(wider);
  }
  return lower_;
}

/// Of an entry where nothing is held.
void HeldStiffness::change(int row, int column, double by) {
  if (held_[row] || held_[column]) return;
  const std::ptrdiff_t at = place_of(lower(), row, column);
  if (at < 0) throw std::logic_error("held stiffness: there is no room for an entry");
  changed_.push_back({at, row, column, by});
}

/// Knows the entries of what may be held, which are few, so that not all are looked at in each step.
void HeldStiffness::watch() {
  watched_.assign(static_cast<std::size_t>(problem_.unknowns()), 0);
  for (const int unknown : basis_.unknown)
    if (unknown >= 0) watched_[unknown] = 1;
  for (const int unknown : fixing_noticed_) watched_[unknown] = 1;
  algebra::each_entry_of(lower(), watched_, [&](int place, int row, int column) { of_watched_.push_back({place, row, column}); });
}

void HeldStiffness::spring_rows(const Vector& spring) {
  for (int r = 0; r < problem_.rows(); ++r)
    for (SparseRows::InnerIterator i(rows_, r); i && spring[r] != 0; ++i)
      for (SparseRows::InnerIterator j(rows_, r); j && j.col() <= i.col(); ++j)
        change(static_cast<int>(i.col()), static_cast<int>(j.col()), spring[r] * (i.value() * j.value()));
}

std::vector<HeldStiffness::Entry> HeldStiffness::now() {
  std::sort(changed_.begin(), changed_.end(), [](const Entry& a, const Entry& b) { return a.place < b.place; });
  std::vector<Entry> now;
  for (const Entry& e : changed_) {
    if (now.empty() || now.back().place != e.place) now.push_back(e);
    else now.back().by += e.by;
  }
  changed_.clear();
  return now;
}

algebra::Triplets HeldStiffness::numbers(const std::vector<Entry>& now) const {
  algebra::Triplets all;
  const double* without = lower().valuePtr();
  auto old = told_.begin();
  for (const Entry& e : now) {
    for (; old != told_.end() && old->place < e.place; ++old) all.emplace_back(old->row, old->column, without[old->place]);
    if (old != told_.end() && old->place == e.place) ++old;
    all.emplace_back(e.row, e.column, without[e.place] + e.by);
  }
  for (; old != told_.end(); ++old) all.emplace_back(old->row, old->column, without[old->place]);
  return all;
}

bool HeldStiffness::factor(const Vector& spring, const std::vector<char>& held, const std::vector<Eigen::Triplet<double>>& added) {
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] && !watched_[i]) throw std::logic_error("held stiffness: an unknown is held that is neither a row's nor one of fixing_noticed()");
  held_ = held;
  const double* K = lower().valuePtr();
  for (const Entry& e : of_watched_) {
    const double number = K[e.place], without = e.row == e.column ? (number > 0 ? number : 1) : 0;
    if ((held[e.row] || held[e.column]) && number != without) changed_.push_back({e.place, e.row, e.column, without - number});
  }
  for (const int unknown : fixing_) change(unknown, unknown, lower().coeff(unknown, unknown));
  spring_rows(spring);
  for (const auto& entry : added) change(entry.row(), entry.col(), entry.value());
  std::vector<Entry> told = now();
  const bool definite = solver_->set(numbers(told), held_);
  told_ = std::move(told);
  return definite;
}

void HeldStiffness::take_near_rows() {
  place_.assign(static_cast<std::size_t>(problem_.unknowns()), -1);
  const auto note = [&](Eigen::Index unknown) { place_[unknown] = 0; };
  for (const SparseRows* rows : {&problem_.B, static_cast<const SparseRows*>(&rows_)})
    for (int r = 0; r < rows->rows(); ++r)
      for (SparseRows::InnerIterator it(*rows, r); it; ++it) note(it.col());
  for (const Entry& e : of_watched_) note(e.row), note(e.column);
  for (const int unknown : fixing_) note(unknown);
  for (Eigen::Index j = 0; j < basis_.T.cols(); ++j)
    for (SparseMatrix::InnerIterator it(basis_.T, j); it; ++it)
      if (it.row() != j || it.value() != 1) note(it.row()), note(j);
  for (Eigen::Index i = 0; i < basis_.signs.size(); ++i)
    if (basis_.signs[i] != 1) note(i);
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (place_[i] == 0) place_[i] = static_cast<int>(near_.size()), near_.push_back(static_cast<int>(i));
  algebra::with_columns(problem_.B, place_, jumps_), algebra::with_columns(rows_, place_, near_jumps_);
  if (basis_.signs.size() > 0) near_basis_.signs = basis_.signs(near_);
  if (!basis_.of_signs()) near_basis_.T = algebra::part_of(basis_.T, place_, near_);
  vectors_ = problem::vectors(problem_, near_);
}

void HeldStiffness::empty_held(Vector& near) const {
  for (std::size_t k = 0; k < near_.size(); ++k)
    if (held_[near_[k]]) near[static_cast<Eigen::Index>(k)] = 0;
}

Vector HeldStiffness::resistance(const Vector& y, Vector Ay) const {
  for (const Entry& e : told_) {
    if (held_[e.row] || held_[e.column]) continue;
    const int i = place_[e.row], j = place_[e.column];
    Ay[i] -= e.by * y[j];
    if (i != j) Ay[j] -= e.by * y[i];
  }
  empty_held(Ay);
  each_watched_force(y, [&](int unknown, double force) {
    if (held_[unknown]) Ay[place_[unknown]] += force;
  });
  return Ay;
}

Vector HeldStiffness::resistance_of_watched(const Vector& y) const {
  Vector forces = Vector::Zero(y.size());
  each_watched_force(y, [&](int unknown, double force) { forces[place_[unknown]] += force; });
  return forces;
}

template <class Visit>
void HeldStiffness::each_watched_force(const Vector& y, const Visit& visit) const {
  const double* K = lower().valuePtr();
  for (const Entry& e : of_watched_) {
    visit(e.row, K[e.place] * y[place_[e.column]]);
    if (e.row != e.column) visit(e.column, K[e.place] * y[place_[e.row]]);
  }
}

HeldStiffness::Displaced HeldStiffness::solve_in_basis(Field& elsewhere, Vector near, double tolerance) const {
  empty_held(near);
  elsewhere.set_watched(near);
  Displaced out{true, false, field(), {}, field(), {}};
  const auto [found, told] = solver_->solve_fields(elsewhere, tolerance, out.u, out.left);
  out.found = found, out.told = told;
  if (!found && solver_->iterates() && std::isfinite(elsewhere.moduli()))
    throw SlowIterations(text(solver_->method(), ": no solution of a linear system within the iterations allowed, as with a nearly incompressible material, "
                          "stretched cells or great contrasts of stiffness; dotyk.solver.pdas{ linear = \"factor\" } does without iterations"));
  const Vector moved = out.u.watched();
  if (told) {
    out.near_resistance = resistance(moved, near - out.left.watched());
    out.left.set_watched(Vector::Zero(near.size()));
  }
  out.near_u = near_basis_.displacements(moved);
  out.u.set_watched(out.near_u);
  if (unnoticed_.cols() > 0) out.u = noticed(problem::Displacement(std::move(out.u))), out.near_u = out.u.watched();
  return out;
}

Field HeldStiffness::field(const problem::Displacement& u) const {
  if (u.there() && u.there()->where() == vectors_) return *u.there();
  Field all = field();
  all.put(u.here());
  return all;
}

problem::Displacement HeldStiffness::interpolated(const problem::Coarser& coarse, const problem::Displacement& u) const {
  Field finer = field();
  if (!solver_->interpolate(*problem::field(coarse.problem, u), finer)) return coarse.finer_displacement(u);
  finer.set_watched(near_basis_.displacements(finer.watched()));
  return problem::Displacement(std::move(finer));
}

Vector HeldStiffness::solve(const Vector& b) const {
  Field forces = field();
  forces.put(b);
  return solve_in_basis(forces, near_basis_.forces(forces.watched())).u.get();
}

}  // namespace dotyk::solver

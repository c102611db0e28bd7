#include "problem/condensed.hpp"

#include "algebra/dense/dense.hpp"
#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "problem/residual.hpp"

namespace dotyk::problem {

using algebra::DenseMatrix;
using algebra::SparseRows;
using algebra::Vector;

namespace {

/// The rate of sweeps with many columns, in rates of a factorisation; and they need no ordering.
constexpr double kFaster = 2;
constexpr double kEps = std::numeric_limits<double>::epsilon(), kSum = 128, kFew = 4;  // roundings: of long sums of what solves gave, and of a row's few terms

/// What orderings keep together, one entry an unknown, and which of it goes last.
struct Grouping {
  std::vector<int> of_unknown, last;
};

/// The unknowns of a node that some row acts on, and its others apart: where normals are along an axis, Γ is a third of what its nodes have. Where the rows
/// of a free body act on a small part, a few unknowns far from it go last as well: algebra::far_unknowns().
Grouping apart(const Block& block, const SparseRows& rows) {
  std::vector<char> touched(block.node.size(), 0);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) touched[it.col()] = 1;
  if (block.kernel.cols() > 0) {
    std::vector<int> unknowns;
    for (std::size_t i = 0; i < touched.size(); ++i)
      if (touched[i]) unknowns.push_back(static_cast<int>(i));
    for (const int i : algebra::far_unknowns(block.kernel, unknowns)) touched[i] = 1;
  }
  Grouping out;
  int group = -1;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (i == 0 || block.node[i] != block.node[i - 1] || touched[i] != touched[i - 1]) {
      ++group;
      if (touched[i]) out.last.push_back(group);
    }
    out.of_unknown.push_back(group);
  }
  return out;
}

/// Columns picked and renumbered: column boundary[k] becomes k.
SparseRows restrict_columns(const SparseRows& rows, const std::vector<int>& boundary) {
  algebra::Triplets picked;
  for (std::size_t k = 0; k < boundary.size(); ++k) picked.emplace_back(boundary[k], static_cast<int>(k), 1);
  return rows * algebra::from_triplets<SparseRows>(rows.cols(), static_cast<Eigen::Index>(boundary.size()), picked);
}

/// The rows that act on this block, as indices.
std::vector<int> rows_present(const SparseRows& rows) {
  std::vector<int> present;
  for (int r = 0; r < rows.rows(); ++r)
    if (SparseRows::InnerIterator(rows, r)) present.push_back(r);
  return present;
}

}  // namespace

std::vector<CondensedBlock> condense(const Problem& problem, algebra::Ordering ordering, Clock& clock, Monitor& monitor) {
  Stopwatch watch;
  std::vector<CondensedBlock> parts;
  std::vector<double> flops;
  for (const Block& block : problem.blocks) {  // one after another: METIS draws its random numbers from the C library
    monitor.check();
    monitor.phase(text("ordering '", block.name, "' (", block.size(), " unknowns)"));
    const SparseRows rows = problem.rows_of(block);
    const Grouping groups = apart(block, rows);
    algebra::Condensation condensation(block.K, groups.of_unknown, groups.last, block.kernel, ordering);
    SparseRows on_boundary = restrict_columns(rows, condensation.boundary());
    flops.push_back(condensation.cholesky().flops());
    parts.push_back({std::move(condensation), std::move(on_boundary), {}, block.first, block.size()});
  }
  double bytes = 0;
  for (const CondensedBlock& part : parts) bytes += part.condensation.cholesky().bytes();
  if (parts.size() > 1) require_memory(bytes, text("the factors of ", parts.size(), " bodies"));
  clock.ordering += watch.lap();
  const auto phase = [&](int b, int) {
    return text("factoring '", problem.blocks[b].name, "' (", parts[b].condensation.cholesky().method(), ", ", flops[b] * 1e-9, " Gflop)");
  };
  algebra::factor_in_threads(flops, phase, monitor, [&](int b) {
    const Block& block = problem.blocks[b];
    if (parts[b].condensation.factor(block.K)) return;
    refuse_singular(block, parts[b].condensation.failed_unknown());
  });
  clock.factor += watch.lap();
  return parts;
}

CondensingWork work_of_condensing(const Problem& problem) {
  const double m = problem.rows();
  CondensingWork work{m * m * m, dense_bytes(m)};
  for (const Block& block : problem.blocks) {
    const SparseRows rows = problem.rows_of(block);
    const Grouping groups = apart(block, rows);
    const algebra::Condensation condensation(block.K, groups.of_unknown, groups.last, block.kernel);
    const double gamma = static_cast<double>(condensation.boundary().size());
    work.flops += condensation.cholesky().flops() + m * gamma * (gamma + m);
    work.bytes += condensation.cholesky().bytes() + 8 * gamma * (gamma + m);
  }
  return work;
}

CondensedProblem::CondensedProblem(const Problem& problem, const RigidMotions& rigid,
                                   algebra::Ordering ordering, Clock& clock, Monitor& monitor)
    : unknowns_(problem.unknowns()) {
  Stopwatch watch;
  const int m = problem.rows();
  require_memory(dense_bytes(m), text("the dense matrix of ", m, " rows"));
  W_ = DenseMatrix::Zero(m, m);
  first_rows_.resize(m);
  std::iota(first_rows_.begin(), first_rows_.end(), 0);
  set_motions(problem, rigid);
  clock.iterate += watch.lap();
  std::vector<CondensedBlock> parts = condense(problem, ordering, clock, monitor);
  watch.lap();
  for (std::size_t b = 0; b < parts.size(); ++b) {
    monitor.check();
    monitor.phase(text("condensing '", problem.blocks[b].name, "' onto ", parts[b].condensation.boundary().size(), " contact unknowns"));
    const algebra::StopFactoring stop(monitor);
    add(std::move(parts[b]));
  }
  set_load(problem, rigid);
  clock.iterate += watch.lap();
}

void CondensedProblem::set_motions(const Problem& problem, const RigidMotions& rigid) {
  noticed_ = rigid.noticed;
  N_ = rigid.noticed_N;
  unnoticed_ = unnoticed_displacements(problem, rigid);
}

void CondensedProblem::set_load(const Problem& problem, const RigidMotions& rigid) {
  x0_ = -problem.c;
  e_ = rigid.noticed_e;
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    Part& part = parts_[b];
    if (part.all_rows.rows() == 0) {
      part.take_load(problem.blocks[b].f);
      x0_ += part.rows * part.condensation.solve(part.load);
    } else {
      part.f = problem.blocks[b].f;
      x0_ += part.all_rows * part.condensation.cholesky().solve(part.f);
    }
  }
}

bool CondensedProblem::extend(const Problem& grown, const RigidMotions& rigid, const std::vector<int>& place, Clock& clock, Monitor& monitor) {
  Stopwatch watch;
  const int m = grown.rows();
  std::vector<int> first;  // where the rows are that Γ was made for
  std::vector<char> is_further(m, 1);
  for (const int r : first_rows_) {
    first.push_back(place[r]);
    is_further[place[r]] = 0;
  }
  struct Rows {
    SparseRows all, further;
    std::vector<int> number;  // of the further ones, which act on this block
  };
  std::vector<Rows> rows(parts_.size());
  std::vector<algebra::ReachedSweep> sweeps;
  std::vector<int> block;  // of each sweep
  std::vector<double> flops;
  double again = 0, sum = 0, bytes = dense_bytes(m);
  for (std::size_t b = 0; b < parts_.size(); ++b) {
    const algebra::Condensation& condensation = parts_[b].condensation;
    rows[b].all = grown.rows_of(grown.blocks[b]);
    for (const int r : rows_present(rows[b].all))
      if (is_further[r]) rows[b].number.push_back(r);
    rows[b].further = algebra::pick_rows(rows[b].all, rows[b].number);
    if (condensation.are_far(rows[b].further, grown.blocks[b].kernel)) return false;
    again += condensation.cholesky().flops();
    if (rows[b].number.empty()) continue;
    block.push_back(static_cast<int>(b));
    sweeps.push_back(condensation.cholesky().sweep(rows[b].further));
    flops.push_back(sweeps.back().flops());
    sum += flops.back(), bytes += 2 * sweeps.back().bytes();
  }
  if (sum > kFaster * again || !memory_for(bytes)) return false;
  std::vector<algebra::Condensation::Further> found(block.size());
  const auto phase = [&](int k, int) { return text("condensing '", grown.blocks[block[k]].name, "' onto ", sweeps[k].rows(), " further rows"); };
  algebra::factor_in_threads(flops, phase, monitor, [&](int k) { found[k] = parts_[block[k]].condensation.further(sweeps[k]); });
  DenseMatrix W = DenseMatrix::Zero(m, m);
  W(first, first) = W_(first_rows_, first_rows_);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::vector<int>& number = rows[block[k]].number;
    const DenseMatrix with_first = parts_[block[k]].rows * found[k].on_boundary;
    W(number, number) += found[k].compliance;
    W(first, number) += with_first;
    W(number, first) += with_first.transpose();
  }
  for (std::size_t b = 0; b < parts_.size(); ++b) parts_[b].all_rows.swap(rows[b].all);
  W_ = std::move(W);
  first_rows_ = std::move(first);
  set_motions(grown, rigid);
  clock.factor += watch.lap();
  set_load(grown, rigid);
  clock.iterate += watch.lap();
  return true;
}

CondensedProblem::CondensedProblem(DenseMatrix W, Vector x0)
    : W_(std::move(W)), N_(x0.size(), 0), x0_(std::move(x0)), e_(0) {}

CondensedProblem CondensedProblem::softened(const Vector& compliance, const Vector& centre) const {
  CondensedProblem soft(W_, x0_ + compliance.cwiseProduct(centre_.size() ? Vector(centre - centre_) : centre));
  soft.W_.diagonal() += compliance;
  soft.N_ = N_, soft.e_ = e_;
  soft.centre_ = centre_, soft.centre_motion_ = centre_motion_, soft.rounding_ = rounding_;
  return soft;
}

CondensedProblem CondensedProblem::centred(const Problem& problem, const Vector& lambda, const Vector& alpha, const Vector& u) const {
  CondensedProblem about(W_, problem.B * u - problem.c);
  about.N_ = N_, about.e_ = e_;
  about.centre_ = lambda, about.centre_motion_ = alpha;
  about.rounding_ = kFew * kEps * (problem.B.cwiseAbs() * u.cwiseAbs() + problem.c.cwiseAbs()) + W_.diagonal().cwiseProduct(rounding_of_forces(problem, {u, lambda}));
  return about;
}

void CondensedProblem::add(CondensedBlock block) {
  Part part{std::move(block), modes_};
  // Only the rows present on this block make columns of the half compliance.
  const std::vector<int> present = rows_present(part.rows);
  const DenseMatrix own = algebra::gram(part.condensation.half_compliance(algebra::pick_rows(part.rows, present)));
  for (std::size_t j = 0; j < present.size(); ++j)
    for (std::size_t i = 0; i < present.size(); ++i) W_(present[i], present[j]) += own(i, j);
  modes_ += part.condensation.kernel_size();
  parts_.push_back(std::move(part));
}

Vector CondensedProblem::jump(const Vector& lambda, const Vector& alpha) const {
  if (centre_.size() == 0) return alpha.size() ? Vector(x0_ - W_ * lambda + N_ * alpha) : Vector(x0_ - W_ * lambda);
  return x0_ - W_ * (lambda - centre_) + N_ * (alpha.size() ? Vector(alpha - centre_motion_) : Vector(-centre_motion_));
}

Vector CondensedProblem::rounding(const Vector& lambda, const Vector& alpha) const {
  const bool centred = centre_.size() > 0;
  Vector gross = W_.cwiseAbs() * (centred ? Vector(lambda - centre_) : lambda).cwiseAbs();
  if (alpha.size() > 0) gross += N_.cwiseAbs() * (centred ? Vector(alpha - centre_motion_) : alpha).cwiseAbs();
  if (!centred) return kSum * kEps * (gross + x0_.cwiseAbs());
  return rounding_ + kSum * kEps * gross;
}

template <class Of>
Vector CondensedProblem::together(const Vector& alpha, const Of& of) const {
  Vector u(unknowns_);
  const Vector motion = alpha.size() ? Vector(noticed_ * alpha) : Vector::Zero(modes_);
  for (const Part& part : parts_)
    u.segment(part.first_unknown, part.size) =
        of(part, Vector(part.condensation.boundary_kernel() * motion.segment(part.first_mode, part.condensation.kernel_size())));
  return least(unnoticed_, std::move(u));
}

Vector CondensedProblem::recover(const Vector& lambda, const Vector& alpha) const {
  return together(alpha, [&](const Part& part, const Vector& moved) {
    if (part.all_rows.rows() > 0) return part.condensation.response(part.f - part.all_rows.transpose() * lambda, moved);
    return part.condensation.recover(part.condensation.solve(part.load - part.rows.transpose() * lambda) + moved);
  });
}

Vector CondensedProblem::response(const Vector& f, const Vector& alpha) const {
  return together(alpha, [&](const Part& part, const Vector& moved) {
    return part.condensation.response(f.segment(part.first_unknown, part.size), moved);
  });
}

double CondensedProblem::factor_bytes() const {
  double bytes = 0;
  for (const Part& part : parts_) bytes += part.condensation.cholesky().bytes();
  return bytes;
}

std::string CondensedProblem::ordering() const {
  std::string names;
  for (const Part& part : parts_)
    if (names.find(part.condensation.cholesky().method()) == std::string::npos)
      names += (names.empty() ? "" : ", ") + part.condensation.cholesky().method();
  return names;
}

const CondensedProblem& Condenser::condense(const Problem& problem, const RigidMotions& rigid,
                                            algebra::Ordering ordering, Clock& clock, Monitor& monitor) {
  if (const auto place = std::exchange(place_, std::nullopt); place && condensed_) {
    const bool follows = static_cast<int>(place->size()) == condensed_->rows() && problem.unknowns() == condensed_->unknowns();
    if (follows && condensed_->extend(problem, rigid, *place, clock, monitor)) return *condensed_;
    condensed_.reset();
  }
  if (!condensed_) return condensed_.emplace(problem, rigid, ordering, clock, monitor);
  if (problem.rows() != condensed_->rows() || problem.unknowns() != condensed_->unknowns())
    throw InputError(text("condensed before with ", condensed_->unknowns(), " unknowns and ", condensed_->rows(),
                          " rows, now there are ", problem.unknowns(), " and ", problem.rows()));
  Stopwatch watch;
  condensed_->set_load(problem, rigid);
  clock.iterate += watch.lap();
  return *condensed_;
}

}  // namespace dotyk::problem

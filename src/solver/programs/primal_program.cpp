#include "solver/programs/primal_program.hpp"

#include <cmath>

#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "problem/residual.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// What the program is put together from.
struct PrimalProgram::Entries {
  Triplets P, B;  ///< lower triangle; the rows of all groups on the program's unknowns
  Vector f;
};

PrimalProgram::PrimalProgram(const Problem& problem, const problem::RigidMotions& rigid, const std::string& method,
                             bool reduced, algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor)
    : problem_(problem), unnoticed_(problem::unnoticed_displacements(problem, rigid)) {
  require_unilateral_or_linear(problem, method);
  Entries entries;
  take_blocks(entries, reduced, ordering, clock, monitor);
  take_rows(entries);
  rescale();
}

void PrimalProgram::take_blocks(Entries& entries, bool reduced, algebra::Ordering ordering, problem::Clock& clock,
                                Monitor& monitor) {
  const auto rows = [&](const SparseRows& B, int first) {
    for (int r = 0; r < B.rows(); ++r)
      for (SparseRows::InnerIterator it(B, r); it; ++it)
        entries.B.emplace_back(r, first + static_cast<int>(it.col()), it.value());
  };
  entries.f = Vector::Zero(problem_.unknowns());
  int first = 0;
  for (const Block& block : problem_.blocks) {
    first_.push_back(first);
    if (reduced) {
      condensed_.push_back(problem::condense(problem_, block, ordering, clock, monitor));
      problem::CondensedBlock& part = condensed_.back();
      part.take_load(block.f);
      const int size = static_cast<int>(part.load.size());
      require_memory(64.0 * size * size, text("the stiffness matrix condensed onto ", size, " unknowns"));
      const algebra::DenseMatrix S = part.condensation.schur();
      for (int j = 0; j < size; ++j)
        for (int i = j; i < size; ++i) entries.P.emplace_back(first + i, first + j, S(i, j));
      rows(part.rows, first);
      entries.f.segment(first, size) = part.load;
      first += size;
    } else {
      for (int j = 0; j < block.size(); ++j)
        for (SparseMatrix::InnerIterator it(block.K, j); it; ++it)
          entries.P.emplace_back(first + static_cast<int>(it.row()), first + j, it.value());
      rows(problem_.rows_of(block), first);
      entries.f.segment(first, block.size()) = block.f;
      first += block.size();
    }
  }
  entries.f.conservativeResize(first);
}

void PrimalProgram::take_rows(Entries& entries) {
  const int n = static_cast<int>(entries.f.size());
  SparseRows B(problem_.rows(), n);
  B.setFromTriplets(entries.B.begin(), entries.B.end());
  Triplets A;
  std::vector<double> low, high;
  program_.q = -entries.f;
  for (const problem::RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const auto k = group.law->linear_stiffness(r - group.first);
      if (k && std::isfinite(*k)) {
        for (SparseRows::InnerIterator i(B, r); i; ++i) {
          program_.q[i.col()] -= *k * problem_.c[r] * i.value();
          for (SparseRows::InnerIterator j(B, r); j; ++j)
            if (i.col() >= j.col())
              entries.P.emplace_back(static_cast<int>(i.col()), static_cast<int>(j.col()), *k * i.value() * j.value());
        }
        continue;
      }
      for (SparseRows::InnerIterator it(B, r); it; ++it)
        A.emplace_back(static_cast<int>(rows_.size()), static_cast<int>(it.col()), it.value());
      rows_.push_back(r);
      low.push_back(k ? problem_.c[r] : -INFINITY);
      high.push_back(problem_.c[r]);
    }
  program_.P.resize(n, n);
  program_.P.setFromTriplets(entries.P.begin(), entries.P.end());
  program_.A.resize(static_cast<int>(rows_.size()), n);
  program_.A.setFromTriplets(A.begin(), A.end());
  program_.low = Eigen::Map<const Vector>(low.data(), static_cast<Eigen::Index>(low.size()));
  program_.high = Eigen::Map<const Vector>(high.data(), static_cast<Eigen::Index>(high.size()));
}

/// The tolerances of programs are beside 1. What drives the solution, forces and rows that zero violates,
/// makes the unit, each turned into the root of an energy by the stiffness on the diagonal.
void PrimalProgram::rescale() {
  const Vector stiffness = program_.P.diagonal();
  double unit = 0;
  for (int j = 0; j < program_.unknowns(); ++j)
    if (stiffness[j] > 0) unit = std::max(unit, std::abs(program_.q[j]) / std::sqrt(stiffness[j]));
  for (int r = 0; r < program_.rows(); ++r) {
    double compliance = 0;
    for (SparseRows::InnerIterator it(program_.A, r); it; ++it)
      if (stiffness[it.col()] > 0) compliance += it.value() * it.value() / stiffness[it.col()];
    const double violation = std::max(-program_.high[r], program_.low[r]);
    if (violation > 0 && compliance > 0) unit = std::max(unit, violation / std::sqrt(compliance));
  }
  if (unit > 0 && std::isfinite(unit)) unit_ = unit;
  program_.q /= unit_;
  program_.low /= unit_;
  program_.high /= unit_;
}

problem::State PrimalProgram::state(const Vector& x, const Vector& y) const {
  problem::State state{Vector::Zero(problem_.unknowns()), Vector::Zero(problem_.rows())};
  for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
    const Block& block = problem_.blocks[b];
    auto u = state.u.segment(block.first, block.size());
    if (condensed_.empty()) u = unit_ * x.segment(first_[b], block.size());
    else u = condensed_[b].condensation.recover(unit_ * x.segment(first_[b], condensed_[b].load.size()));
  }
  state.u = problem::least(unnoticed_, std::move(state.u));
  for (std::size_t r = 0; r < rows_.size(); ++r) state.lambda[rows_[r]] = unit_ * y[static_cast<Eigen::Index>(r)];
  const Vector jump = problem_.B * state.u - problem_.c;
  for (const problem::RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      if (const auto k = group.law->linear_stiffness(r - group.first); k && std::isfinite(*k))
        state.lambda[r] = *k * jump[r];
  return state;
}

double PrimalProgram::factor_bytes() const {
  double bytes = 0;
  for (const auto& part : condensed_) bytes += part.condensation.cholesky().bytes();
  return bytes;
}

namespace {

/// Tells the watcher of a program's iterations and writes them into a history.
class Recorder final : public Monitor {
 public:
  Recorder(Monitor& watcher, std::vector<IterationInfo>& history) : watcher_(watcher), history_(history) {}
  void phase(const std::string& what) override { watcher_.phase(what); }
  bool stop() override { return watcher_.stop(); }
  void iteration(const IterationInfo& info) override {
    history_.push_back(info);
    watcher_.iteration(info);
  }

 private:
  Monitor& watcher_;
  std::vector<IterationInfo>& history_;
};

/// Closed rows: those in the program's working set, and those whose force is larger in relation to all forces than their gap is in relation to
/// all displacements. An interior-point method may end while slack and multiplier of a row are still of one size in the program's units.
std::vector<char> closed_rows(const Problem& problem, const PrimalProgram& primal, const program::Result& solved, const problem::State& state) {
  std::vector<char> closed(problem.rows(), 1);  // elastic and bilateral rows always act
  const std::vector<problem::Scales> scales = problem::scales(problem, state);
  const Vector jump = problem.B * state.u - problem.c;
  for (std::size_t k = 0; k < primal.rows().size(); ++k) {
    const int r = primal.rows()[k];
    const bool held = !solved.working.empty() && solved.working[k] != program::Side::free;
    const problem::Scales& scale = scales[static_cast<std::size_t>(r)];
    closed[r] = held || std::abs(state.lambda[r]) * scale.length > std::abs(jump[r]) * scale.force;
  }
  return closed;
}

/// What a program's solution says of the problem.
void take_over(const Problem& problem, const PrimalProgram& primal, const program::Result& solved, Result& result) {
  result.converged = solved.status == program::Status::solved;
  result.reason = solved.reason;
  result.iterations = solved.iterations;
  result.factor_bytes = primal.factor_bytes();
  result.state = primal.state(solved.x, solved.y);
  result.active_sets.push_back(closed_rows(problem, primal, solved, result.state));
}

}  // namespace

Result solve_primal(const Problem& problem, const std::string& method, bool reduced, algebra::Ordering ordering,
                    Monitor& monitor,
                    const std::function<program::Result(const PrimalProgram&, Monitor&)>& solve) {
  Result result;
  require_unilateral_or_linear(problem, method);
  const auto [rigid, note] = require_solvable(problem, result.clock, monitor);
  const PrimalProgram primal(problem, rigid, method, reduced, ordering, result.clock, monitor);
  Stopwatch watch;
  Recorder recorder(monitor, result.history);
  const program::Result solved = solve(primal, recorder);
  result.clock.iterate += watch.lap();
  take_over(problem, primal, solved, result);
  result.clock.recover += watch.lap();
  result.method = method;
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

}  // namespace dotyk::solver

#include "solver/programs/program_methods.hpp"

#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "problem/residual.hpp"
#include "program/interior_point.hpp"
#include "solver/active/linearisation.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;

PrimalProgram::PrimalProgram(const Problem& problem, const problem::RigidMotions& rigid, const std::string& method,
                             bool reduced, algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor)
    : problem_(problem), spring_(Vector::Zero(problem.rows())), unnoticed_(problem::unnoticed_displacements(problem, rigid)) {
  require_unilateral_or_linear(problem, method);
  if (reduced) {
    take_rows(condense(ordering, clock, monitor));
  } else {
    program_.P = problem::lower_stiffness(problem);
    program_.q.resize(problem.unknowns());
    for (const Block& block : problem.blocks) program_.q.segment(block.first, block.size()) = -block.f;
    take_rows(problem.B);
  }
}

/// Fills P and q by the blocks condensed; returns B on their unknowns.
SparseRows PrimalProgram::condense(algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor) {
  std::vector<Eigen::Triplet<double>> stiffness, rows;
  std::vector<double> load;
  condensed_ = problem::condense(problem_, ordering, clock, monitor);
  for (std::size_t b = 0; b < condensed_.size(); ++b) {
    monitor.check();
    problem::CondensedBlock& part = condensed_[b];
    part.take_load(problem_.blocks[b].f);
    const int first = static_cast<int>(load.size()), size = static_cast<int>(part.load.size());
    require_memory(64.0 * size * size, text("the stiffness matrix condensed onto ", size, " unknowns"));
    const algebra::DenseMatrix S = part.condensation.schur();
    for (int j = 0; j < size; ++j)
      for (int i = j; i < size; ++i) stiffness.emplace_back(first + i, first + j, S(i, j));
    for (int r = 0; r < part.rows.rows(); ++r)
      for (SparseRows::InnerIterator it(part.rows, r); it; ++it)
        rows.emplace_back(r, first + static_cast<int>(it.col()), it.value());
    load.insert(load.end(), part.load.begin(), part.load.end());
  }
  const auto n = static_cast<Eigen::Index>(load.size());
  program_.P.resize(n, n);
  program_.P.setFromTriplets(stiffness.begin(), stiffness.end());
  program_.q = -Eigen::Map<const Vector>(load.data(), n);
  SparseRows B(problem_.rows(), n);
  B.setFromTriplets(rows.begin(), rows.end());
  return B;
}

void PrimalProgram::take_rows(const SparseRows& B) {
  std::vector<int> springs;
  std::vector<double> low;
  for (const problem::RowGroup& group : problem_.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      const auto k = group.law->linear_stiffness(r - group.first);
      if (k && std::isfinite(*k)) {
        spring_[r] = *k;
        springs.push_back(r);
      } else {
        rows_.push_back(r);
        low.push_back(k ? problem_.c[r] : -INFINITY);
      }
    }
  const SparseRows elastic = algebra::pick_rows(B, springs), pull = spring_(springs).asDiagonal() * elastic;
  program_.P += SparseMatrix(SparseMatrix(elastic.transpose() * pull).triangularView<Eigen::Lower>());
  program_.q -= pull.transpose() * problem_.c(springs);
  program_.A = algebra::pick_rows(B, rows_);
  program_.low = Eigen::Map<const Vector>(low.data(), static_cast<Eigen::Index>(low.size()));
  program_.high = problem_.c(rows_);
}

problem::State PrimalProgram::state(const Vector& x, const Vector& y) const {
  Vector u = x;
  if (!condensed_.empty()) u.resize(problem_.unknowns());
  Eigen::Index first = 0;
  for (std::size_t b = 0; b < condensed_.size(); ++b) {
    const Eigen::Index size = condensed_[b].load.size();
    u.segment(problem_.blocks[b].first, problem_.blocks[b].size()) = condensed_[b].condensation.recover(x.segment(first, size));
    first += size;
  }
  problem::State state{problem::least(unnoticed_, std::move(u)), {}};
  state.lambda = spring_.cwiseProduct(problem::jumps(problem_, state.u));
  state.lambda(rows_) = y;
  return state;
}

double PrimalProgram::factor_bytes() const {
  double bytes = 0;
  for (const auto& part : condensed_) bytes += part.condensation.cholesky().bytes();
  return bytes;
}

namespace {

/// What the laws' residual, relative to the forces, is to be at the end of the interior-point method: the gap is relative to the energy, and
/// where bodies are displaced as a whole that is far more than what presses them.
constexpr double kFine = 1e-8;

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
  const problem::Measure measure(problem, state);
  const Vector jump = problem::jumps(problem, state.u);
  for (std::size_t k = 0; k < primal.rows().size(); ++k) {
    const int r = primal.rows()[k];
    const bool held = !solved.working.empty() && solved.working[k] != program::Side::free;
    closed[r] = held || std::abs(state.lambda[r]) * measure.length_of_row(r) > std::abs(jump[r]) * measure.force_of_row(r);
  }
  return closed;
}

/// States a frictionless problem as a program, has it solved, and takes over state, rows closed at the end, history, times
/// and how it ended. `method` is the result's, and names who asks in messages.
template <class Method>
Result solve_primal(const Problem& problem, const std::string& method, const Method& settings, Monitor& monitor,
                    const std::function<program::Result(const PrimalProgram&, Monitor&)>& solve) {
  Result result;
  require_unilateral_or_linear(problem, method);
  const auto [rigid, note] = require_solvable(problem, result.clock, monitor);
  const PrimalProgram primal(problem, rigid, method, settings.reduced, settings.ordering, result.clock, monitor);
  Stopwatch watch;
  Recorder recorder(monitor, result.history);
  const program::Result solved = solve(primal, recorder);
  result.clock.iterate += watch.lap();
  result.converged = solved.status == program::Status::solved;
  result.reason = solved.reason;
  result.iterations = solved.iterations;
  result.factor_bytes = primal.factor_bytes();
  result.state = primal.state(solved.x, solved.y);
  result.active_sets.push_back(closed_rows(problem, primal, solved, result.state));
  result.clock.recover += watch.lap();
  result.method = method;
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

/// The first working set: the rows flagged, or those that touch at rest.
program::ActiveSet options(const Problem& problem, const ActiveSet& settings, const PrimalProgram& primal) {
  const program::QuadraticProgram& p = primal.program();
  program::ActiveSet out{settings.change, program::ActiveSet::Start::cold, settings.tol, settings.max_iterations, {}, {}};
  const std::vector<char> first = first_active(problem, settings.start);
  for (int k = 0; k < p.rows(); ++k)
    out.working.push_back(p.equality(k) ? program::Side::equal : first[primal.rows()[k]] ? program::Side::high : program::Side::free);
  if (settings.start.empty()) out.point = Vector::Zero(p.unknowns());
  return out;
}

}  // namespace

Result solve(const Problem& problem, const ActiveSet& settings, Monitor& monitor) {
  WorkingSetCounts counts;
  Result result = solve_primal(problem, "active_set", settings, monitor, [&](const PrimalProgram& primal, Monitor& recorder) {
    program::Result solved = program::solve(primal.program(), options(problem, settings, primal), recorder);
    counts = {solved.added,    solved.dropped,        solved.singular,
              solved.survived, solved.factorisations, solved.repeats};
    return solved;
  });
  if (settings.change == ActiveSet::Change::many) result.method = "active_set (many)";
  result.working_set = counts;
  return result;
}

Result solve(const Problem& problem, const InteriorPoint& settings, Monitor& monitor) {
  return solve_primal(problem, "interior_point", settings, monitor, [&](const PrimalProgram& primal, Monitor& recorder) {
    const auto fine = [&](const Vector& x, const Vector& y) { return problem::residual(problem, primal.state(x, y)).law <= kFine; };
    return program::solve(primal.program(), program::InteriorPoint{settings.tol, settings.max_iterations, fine}, recorder);
  });
}

}  // namespace dotyk::solver

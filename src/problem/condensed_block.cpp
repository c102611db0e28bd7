#include "problem/condensed_block.hpp"

#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using algebra::SparseRows;

namespace {

/// What orderings keep together, one entry an unknown, and which of it goes last.
struct Grouping {
  std::vector<int> of_unknown, last;
};

/// The unknowns of a node that some row acts on, and its others apart: where normals are along an axis, Γ is a third of what its nodes have.
Grouping apart(const Block& block, const SparseRows& rows) {
  std::vector<char> touched(block.node.size(), 0);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) touched[it.col()] = 1;
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
  std::vector<int> place(rows.cols(), -1);
  for (std::size_t k = 0; k < boundary.size(); ++k) place[boundary[k]] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it)
      entries.emplace_back(r, place[it.col()], it.value());
  SparseRows result(rows.rows(), static_cast<int>(boundary.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

CondensedBlock condense(const Problem& problem, const Block& block, algebra::Ordering ordering, Clock& clock,
                        Monitor& monitor) {
  Stopwatch watch;
  const SparseRows rows = problem.rows_of(block);
  monitor.phase(text("ordering '", block.name, "' (", block.size(), " unknowns)"));
  const Grouping groups = apart(block, rows);
  CondensedBlock part{{block.K, groups.of_unknown, groups.last, block.kernel, ordering}, {}, {}, block.first, block.size()};
  clock.ordering += watch.lap();
  monitor.check();
  monitor.phase(text("factoring '", block.name, "' (", part.condensation.cholesky().method(), ", ",
                     part.condensation.cholesky().flops() * 1e-9, " Gflop)"));
  const algebra::StopFactoring stop(monitor);
  if (!part.condensation.factor(block.K)) {
    const int unknown = part.condensation.failed_unknown();
    throw InputError(text("the stiffness of '", block.name, "' is singular",
                          unknown >= 0 ? text(" (node ", block.node[unknown] + 1, " is not held)") : "",
                          block.kernel.cols() > 0 ? text(" beyond its ", block.kernel.cols(), " rigid motions") : "",
                          ": a material, spring or mesh value is out of range, or cells hang together at single nodes only"));
  }
  clock.factor += watch.lap();
  monitor.check();

  monitor.phase(text("condensing '", block.name, "' onto ", part.condensation.boundary().size(),
                     " contact unknowns"));
  part.rows = restrict_columns(rows, part.condensation.boundary());
  clock.iterate += watch.lap();
  return part;
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

}  // namespace dotyk::problem

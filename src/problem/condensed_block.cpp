#include "problem/condensed_block.hpp"

#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using algebra::SparseRows;

namespace {

/// The nodes of a block that some row acts on.
std::vector<int> nodes_of_rows(const Block& block, const SparseRows& rows) {
  std::vector<char> touched(block.node.empty() ? 0 : block.node.back() + 1, 0);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) touched[block.node[it.col()]] = 1;
  std::vector<int> nodes;
  for (std::size_t n = 0; n < touched.size(); ++n)
    if (touched[n]) nodes.push_back(static_cast<int>(n));
  return nodes;
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
  CondensedBlock part{{block.K, block.node, nodes_of_rows(block, rows), block.kernel, ordering}, {}, {}, block.first,
                      block.size()};
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

}  // namespace dotyk::problem

#include "algebra/direct/ordering.hpp"

#include <algorithm>

#include "algebra/direct/cholmod_handle.hpp"
#include "base/counted.hpp"

namespace dotyk::algebra {
namespace {

/// Above this many predicted flops per node METIS pays: it costs some 4 µs a node more than
/// AMD and, where fill is large, saves about half of the flops, at some 40 Gflop/s (measured:
/// plane meshes of 10⁶ unknowns stay below, 3-D ones of 10⁴ are above).
constexpr double kDissectionFlopsPerNode = 3e5;

/// Above these many a second ordering by minimum degree, and a third, pay: each costs what some 5e3 flops a node do.
constexpr double kSecondFlopsPerNode = 2e4, kThirdFlopsPerNode = 4e4;

/// The graph of nodes that carry unknowns, as a lower-triangular pattern.
struct NodeGraph {
  std::vector<int> first;     ///< graph node → its first unknown; one past the end last
  std::vector<int> of_node;   ///< mesh node → graph node or -1
  std::vector<int> start, neighbour;

  int size() const { return static_cast<int>(first.size()) - 1; }

  cholmod_sparse view() {
    cholmod_sparse a{};
    a.nrow = a.ncol = size();
    a.nzmax = neighbour.size();
    a.p = start.data();
    a.i = neighbour.data();
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_PATTERN;
    a.sorted = true;
    a.packed = true;
    return a;
  }
};

NodeGraph node_graph(const SparseMatrix& lower, const std::vector<int>& node) {
  const int n = static_cast<int>(node.size());
  NodeGraph g;
  std::vector<int> graph_node(n);
  for (int i = 0; i < n; ++i) {
    if (i == 0 || node[i] != node[i - 1]) g.first.push_back(i);
    graph_node[i] = static_cast<int>(g.first.size()) - 1;
  }
  g.first.push_back(n);
  g.of_node.assign(n ? node.back() + 1 : 0, -1);
  for (int i = 0; i < n; ++i) g.of_node[node[i]] = graph_node[i];
  g.start.push_back(0);
  g.neighbour.reserve(lower.nonZeros() / 2);
  // All unknowns of a node have the same neighbours: its first column tells them.
  for (int k = 0; k < g.size(); ++k) {
    int previous = -1;
    for (SparseMatrix::InnerIterator it(lower, g.first[k]); it; ++it) {
      const int a = graph_node[it.row()];
      if (a != previous) g.neighbour.push_back(a);
      previous = a;
    }
    g.start.push_back(counted(g.neighbour.size()));
  }
  return g;
}

/// Predicted flops of factoring the node graph in this order.
double predict(cholmod_sparse& graph, std::vector<int>& order, CholmodCommon& common) {
  const std::size_t n = graph.nrow;
  std::vector<int> parent(n), post(n), count(n), first(n), level(n);
  cholmod_common* c = common.get();
  cholmod_sparse* upper = cholmod_ptranspose(&graph, 0, order.data(), nullptr, 0, c);
  cholmod_sparse* lower = upper ? cholmod_ptranspose(upper, 0, nullptr, nullptr, 0, c) : nullptr;
  double flops = 0;
  if (lower && cholmod_etree(upper, parent.data(), c) &&
      cholmod_postorder(parent.data(), n, nullptr, post.data(), c) == static_cast<int>(n) &&
      cholmod_rowcolcounts(lower, nullptr, 0, parent.data(), post.data(), nullptr, count.data(),
                           first.data(), level.data(), c))
    flops = c->fl;
  cholmod_free_sparse(&upper, c);
  cholmod_free_sparse(&lower, c);
  common.check("ordering");
  return flops;
}

/// Those of `member`, where there are some, last.
std::vector<int> minimum_degree(cholmod_sparse& graph, std::vector<int>& member, CholmodCommon& common) {
  std::vector<int> order(graph.nrow);
  if (graph.nrow == 1) return order;  // CAMD writes out of bounds
  if (member.empty())
    cholmod_amd(&graph, nullptr, 0, order.data(), common.get());
  else
    cholmod_camd(&graph, nullptr, 0, member.data(), order.data(), common.get());
  common.check("minimum degree ordering");
  return order;
}

std::vector<int> nested_dissection(cholmod_sparse& graph, CholmodCommon& common) {
  std::vector<int> order(graph.nrow);
  cholmod_metis(&graph, nullptr, 0, true, order.data(), common.get());
  common.check("nested dissection");
  return order;
}

/// Of the graph without those of `member`.
std::vector<int> interior_minimum_degree(const NodeGraph& graph, const std::vector<int>& member, CholmodCommon& common) {
  std::vector<int> order, inner, index(graph.size(), -1), none;
  NodeGraph interior;
  for (int k = 0; k < graph.size(); ++k)
    if (member[k] == 0) index[k] = static_cast<int>(inner.size()), inner.push_back(k);
  interior.first.resize(inner.size() + 1);
  interior.start.push_back(0);
  for (const int k : inner) {
    for (int p = graph.start[k]; p < graph.start[k + 1]; ++p)
      if (index[graph.neighbour[p]] >= 0) interior.neighbour.push_back(index[graph.neighbour[p]]);
    interior.start.push_back(counted(interior.neighbour.size()));
  }
  if (inner.empty()) return order;
  cholmod_sparse view = interior.view();
  for (const int k : minimum_degree(view, none, common)) order.push_back(inner[k]);
  return order;
}

}  // namespace

Permutation order(const SparseMatrix& lower, const std::vector<int>& node,
                  const std::vector<int>& last, Ordering choice) {
  if (node.empty()) return {{}, 0, "none"};
  CholmodCommon common;
  NodeGraph graph = node_graph(lower, node);
  cholmod_sparse view = graph.view();
  std::vector<int> member, none;
  if (!last.empty()) {
    member.assign(graph.size(), 0);
    for (int n : last)
      if (n < static_cast<int>(graph.of_node.size()) && graph.of_node[n] >= 0)
        member[graph.of_node[n]] = 1;
  }
  const double block = graph.size() ? static_cast<double>(node.size()) / graph.size() : 1;
  Permutation result;
  std::vector<int> nodes;
  const auto take_if_better = [&](std::vector<int> other, const char* method) {  // without constraint: those of `member` are moved to its end
    if (!member.empty()) std::stable_partition(other.begin(), other.end(), [&](int k) { return member[k] == 0; });
    for (int k = 0; other.size() < member.size(); ++k)
      if (member[k] != 0) other.push_back(k);
    const double flops = block * block * block * predict(view, other, common);
    if (!nodes.empty() && flops >= result.flops) return;
    nodes = std::move(other);
    result.flops = flops;
    result.method = method;
  };
  const auto takes_more_than = [&](double flops_per_node) { return result.flops > flops_per_node * graph.size(); };
  if (choice != Ordering::nested_dissection) take_if_better(minimum_degree(view, member, common), member.empty() ? "AMD" : "CAMD");
  if (choice == Ordering::nested_dissection || (choice == Ordering::automatic && takes_more_than(kDissectionFlopsPerNode))) {
    take_if_better(nested_dissection(view, common), "METIS");
  } else if (!member.empty()) {
    // With many nodes to come last, along all edges of a plate, CAMD fills up to twice as much as these on some meshes.
    if (takes_more_than(kSecondFlopsPerNode)) take_if_better(interior_minimum_degree(graph, member, common), "AMD");
    if (takes_more_than(kThirdFlopsPerNode)) take_if_better(minimum_degree(view, none, common), "AMD");
  }
  result.order.reserve(node.size());
  for (int k : nodes)
    for (int i = graph.first[k]; i < graph.first[k + 1]; ++i) result.order.push_back(i);
  return result;
}

}  // namespace dotyk::algebra

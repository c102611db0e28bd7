#include "multigrid/shares/numbering.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/buckets.hpp"
#include "multigrid/processes/ranks.hpp"

namespace dotyk::multigrid {

namespace {

/// The graph's vertices shared out among `parts` of about the same weight with few edges between them. `weight`: of each vertex; `visit(edge)` calls
/// edge(a, b) as often as the edge weighs.
template <class Visit>
std::vector<int> share_out(std::vector<idx_t> weight, int parts, const Visit& visit) {
  const auto vertices = counted(weight.size());
  const Buckets met(vertices, [&](auto&& put) {
    visit([&](int a, int b) {
      if (a != b) put(a, b), put(b, a);
    });
  });
  std::vector<idx_t> starts{0}, neighbours, weights;
  for (int v = 0; v < vertices; ++v) {
    std::vector<int> own(met[v].begin(), met[v].end());
    std::sort(own.begin(), own.end());
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (k == 0 || own[k] != own[k - 1]) neighbours.push_back(own[k]), weights.push_back(0);
      ++weights.back();
    }
    starts.push_back(counted(neighbours.size()));
  }
  idx_t count = vertices, constraints = 1, wanted = parts, cut = 0, options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> part(static_cast<std::size_t>(vertices));
  const int status = METIS_PartGraphRecursive(&count, &constraints, starts.data(), neighbours.data(), weight.data(), nullptr, weights.data(), &wanted, nullptr,
                                              nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw std::runtime_error("METIS could not share out the unknowns");
  return {part.begin(), part.end()};
}

/// New numbers of nodes, those of rank 0 first; `first`: of each rank its first node, and the number of all.
std::vector<int> numbers_by_rank(const std::vector<int>& rank, int ranks, std::vector<int>& first) {
  first.assign(static_cast<std::size_t>(ranks) + 1, 0);
  for (const int r : rank) ++first[r + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1), number;
  for (const int r : rank) number.push_back(next[r]++);
  return number;
}

constexpr int kEnough = 100;  ///< nodes for each rank, so that shares are alike

/// The ranks of the nodes of all levels.
class Sharing {
 public:
  /// `first`: unknown of each node, and the number of all.
  Sharing(const Coupling& coupling, const std::vector<int>& first, int ranks) : coupling_(coupling), first_(first), ranks_(ranks) {
    const auto meshes = static_cast<int>(coupling.coarse.size());
    for (int l = 0; l <= meshes; ++l) of_.emplace_back(static_cast<std::size_t>(nodes(l)), 0);
    if (ranks == 1) return;
    if (meshes > 0) take_finest(coupling.coarse[0]);
    std::vector<std::vector<int>> parents;
    std::vector<idx_t> weight = finest_weights();  // of a node the sum of those that follow it
    for (int l = 0; l < meshes && nodes(l + 1) >= kEnough * ranks; ++l) {
      std::vector<int> parent = parents_of(l);
      std::vector<idx_t> sum(static_cast<std::size_t>(nodes(l + 1)), 0);
      for (int node = 0; node < nodes(l); ++node) sum[parent[node]] += weight[node];
      const idx_t all = std::accumulate(sum.begin(), sum.end(), idx_t{0}), heaviest = *std::ranges::max_element(sum);
      if (l > 0 && heaviest > all / (kEnough * ranks)) break;  // as where a body has more coarser meshes than the others
      parents.push_back(std::move(parent)), weight = std::move(sum);
    }
    const auto level = static_cast<int>(parents.size());
    of_[level] = share_out(std::move(weight), ranks_, [&](auto&& edge) {
      level > 0 ? functions_meet(level, edge) : nodes_meet(edge);
      rows_join(parents, edge);
    });
    for (int l = level - 1; l >= 0; --l)
      for (int node = 0; node < nodes(l); ++node) of_[l][node] = of_[l + 1][parents[l][node]];
  }

  const std::vector<int>& of(int level) const { return of_[level]; }

 private:
  int nodes(int level) const {
    return level == 0 ? static_cast<int>(first_.size()) - 1 : coupling_.coarse[level - 1].coarse_nodes();
  }
  /// Nodes of level 0 are those with unknowns here; the functions have numbers for all nodes.
  void take_finest(const algebra::CoarseFunctions& finest) {
    for (int i = 0; i < finest.nodes(); ++i) {
      bool used = false;
      finest.each_row_of(i, [&](int, int) { used = true; });
      if (used) finest_.push_back(i);
    }
  }
  int in_functions(int level, int node) const { return level == 0 ? finest_[node] : node; }

  /// Of each node the first one of the next level whose function is not zero there; where there is none, that of the node before.
  std::vector<int> parents_of(int level) const {
    const algebra::CoarseFunctions& functions = coupling_.coarse[level];
    std::vector<int> parent(static_cast<std::size_t>(nodes(level)), -1);
    parallel_parts(nodes(level), [&](int begin, int end) {
      for (int node = begin; node < end; ++node)
        functions.each_row_of(in_functions(level, node), [&](int, int k) {
          if (parent[node] >= 0) return;
          int least = functions.columns;
          functions.each_in_row(in_functions(level, node), k, [&](int column, double) { least = std::min(least, column); });
          if (least < functions.columns) parent[node] = node_of(functions, least);
        });
    });
    for (std::size_t node = 0; node < parent.size(); ++node)
      if (parent[node] < 0) parent[node] = node > 0 ? parent[node - 1] : 0;
    return parent;
  }
  /// Functions that meet at a node of the finer mesh are neighbours.
  template <class Edge>
  void functions_meet(int level, Edge& edge) const {
    const algebra::CoarseFunctions& functions = coupling_.coarse[level - 1];
    for (int node = 0; node < nodes(level - 1); ++node) {
      const int i = in_functions(level - 1, node);
      functions.each_row_of(i, [&](int, int k) {
        functions.each_in_row(i, k, [&](int a, double) {
          functions.each_in_row(i, k, [&](int b, double) {
            if (b < a) edge(node_of(functions, a), node_of(functions, b));
          });
        });
      });
    }
  }
  template <class Edge>
  void nodes_meet(Edge& edge) const {
    const std::vector<int> node = node_of_unknowns();
    coupling_.each_pair([&](int i, int j) { edge(node[i], node[j]); });
  }
  /// Unknowns that a row of an interface couples are kept together: less is exchanged then, and an exact solution at unknowns that share stiffness stays on one rank.
  template <class Edge>
  void rows_join(const std::vector<std::vector<int>>& parents, Edge& edge) const {
    constexpr int kWeight = 10;
    each_coupled([&](int a, int b) {
      for (const std::vector<int>& parent : parents) a = parent[a], b = parent[b];
      for (int times = 0; times < kWeight; ++times) edge(a, b);
    });
  }
  /// Work at nodes: with a row that couples them to others they have more neighbours.
  std::vector<idx_t> finest_weights() const {
    std::vector<idx_t> weight(static_cast<std::size_t>(nodes(0)), 1);
    each_coupled([&](int a, int b) {
      if (a != b) weight[a] = weight[b] = coupling_.weight;
    });
    return weight;
  }
  /// Calls visit(node, node) for the first node of each row with all of them.
  template <class Visit>
  void each_coupled(const Visit& visit) const {
    const std::vector<int> node = node_of_unknowns();
    for (int r = 0; r < coupling_.rows.rows(); ++r)
      for (algebra::SparseRows::InnerIterator first(coupling_.rows, r), it = first; it; ++it) visit(node[first.col()], node[it.col()]);
  }
  std::vector<int> node_of_unknowns() const {
    std::vector<int> node;
    for (int b = 0; b < nodes(0); ++b) node.resize(static_cast<std::size_t>(first_[b + 1]), b);
    return node;
  }

  /// Columns are components of coarse nodes, node by node.
  static int node_of(const algebra::CoarseFunctions& functions, int column) { return column / functions.dimension; }

  const Coupling& coupling_;
  const std::vector<int>& first_;
  const int ranks_;
  std::vector<int> finest_;  ///< of each node of level 0 its number in the functions
  std::vector<std::vector<int>> of_;
};

}  // namespace

Numbering::Numbering(const Coupling& coupling, int ranks) {
  std::vector<int> first;  // unknown of each node
  for (std::size_t i = 0; i < coupling.node.size(); ++i)
    if (i == 0 || coupling.node[i] != coupling.node[i - 1]) first.push_back(static_cast<int>(i));
  first.push_back(static_cast<int>(coupling.node.size()));
  for (std::size_t b = 0; b + 1 < first.size(); ++b) block_ = std::max(block_, first[b + 1] - first[b]);
  const Sharing sharing(coupling, first, ranks);
  const std::vector<int> finest = numbers_by_rank(sharing.of(0), ranks, first_.emplace_back());
  for (std::size_t b = 0; b + 1 < first.size(); ++b) {
    const int begin = finest[b] * block_, used = first[b + 1] - first[b];
    for (int k = 0; k < used; ++k) slot_.push_back(begin + k);
    for (int k = used; k < block_; ++k) idle_.push_back(begin + k);
  }
  for (int& f : first_[0]) f = counted(std::size_t(f) * block_);
  take_unknowns();
  for (std::size_t l = 1; l <= coupling.coarse.size(); ++l) {
    const std::vector<int> number = numbers_by_rank(sharing.of(static_cast<int>(l)), ranks, first_.emplace_back());
    std::vector<int>& rows = functions_.emplace_back();
    const int dimension = coupling.coarse[l - 1].dimension;
    for (const int n : number)
      for (int k = 0; k < dimension; ++k) rows.push_back(n * dimension + k);
    for (int& f : first_[l]) f = counted(std::size_t(f) * dimension);
  }
}

Numbering::Numbering(const Numbering& finer, const algebra::CoarseFunctions& functions)
    : block_(functions.dimension), functions_(finer.functions_.begin() + 1, finer.functions_.end()), first_(finer.first_.begin() + 1, finer.first_.end()) {
  for (std::size_t k = 0; k < functions.column.size(); ++k) (functions.column[k] >= 0 ? slot_ : idle_).push_back(finer.functions_[0][k]);
  take_unknowns();
}

Numbering::Numbering(const std::vector<std::vector<int>>& first, const std::vector<std::vector<int>>& number, const algebra::CoarseFunctions& functions,
                     std::shared_ptr<const Refinement> refinement)
    : block_(functions.dimension), refinement_(std::move(refinement)) {
  for (std::size_t l = 0; l < number.size(); ++l) {
    std::vector<int> rows, &begin = first_.emplace_back(first[l]);
    for (int& f : begin) f = counted(std::size_t(f) * block_);
    for (const int node : number[l])
      for (int k = 0; k < block_; ++k) rows.push_back(node * block_ + k);
    if (l > 0) functions_.push_back(std::move(rows));
    else
      for (std::size_t at = 0; at < rows.size(); ++at) (functions.row[at] >= 0 ? slot_ : idle_).push_back(rows[at]);
  }
  const Numbering& base = refinement_->base;
  functions_.insert(functions_.end(), base.functions_.begin(), base.functions_.end());
  first_.insert(first_.end(), base.first_.begin() + 1, base.first_.end());
  take_unknowns();
}

void Numbering::take_unknowns() {
  unknown_.assign(static_cast<std::size_t>(first_[0].back()), -1);
  for (std::size_t i = 0; i < slot_.size(); ++i) unknown_[slot_[i]] = static_cast<int>(i);
}

void Numbering::put(int rank, const std::vector<double>& part, algebra::Vector& x) const {
  parallel_parts(std::ssize(part), [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      if (const int i = unknown_[first_[0][rank] + k]; i >= 0) x[i] = part[k];
  });
}

int Numbering::rank_of(int row) const { return rank_with(first_[0], row); }

}  // namespace dotyk::multigrid

#include <unordered_set>

#include "mesh/bisection.hpp"
#include "mesh/facet_table.hpp"

namespace dotyk::mesh {

/// A round on meshes that are joined.
class Rounds {
 public:
  Rounds(std::vector<Bisection>& meshes, const std::vector<Joint>& joints, Monitor& monitor)
      : meshes_(meshes), joints_(joints), monitor_(monitor) {
    for (const Joint& joint : joints_) {
      partner_.emplace_back();
      for (const auto& [a, b] : joint.nodes) {
        partner_.back().first.emplace(a, b);
        partner_.back().second.emplace(b, a);
      }
    }
  }

  std::vector<Refined> run(const std::vector<std::vector<int>>& cells) {
    for (std::size_t m = 0; m < meshes_.size(); ++m) meshes_[m].begin(cells[m]);
    for (bool again = true; again;) {
      for (Bisection& mesh : meshes_) mesh.close(monitor_);
      again = false;
      for (std::size_t j = 0; j < joints_.size(); ++j) again = carry_over(j) || again;
    }
    std::vector<Refined> result;
    for (Bisection& mesh : meshes_) result.push_back(mesh.end(monitor_));
    return result;
  }

 private:
  using Map = std::unordered_map<int, int>;

  bool carry_over(std::size_t j) {
    auto& [forth, back] = partner_[j];
    const bool one = carry_over(meshes_[joints_[j].first], meshes_[joints_[j].second], forth, back);
    return carry_over(meshes_[joints_[j].second], meshes_[joints_[j].first], back, forth) || one;
  }

  /// Every edge split here whose ends have partners that are an edge there is split there; the midpoints are partners.
  static bool carry_over(Bisection& here, Bisection& there, Map& partner, Map& inverse) {
    std::vector<std::array<int, 3>> sought;  // midpoint, and the edge there
    for (std::size_t k = 0; k < here.ends_.size(); ++k) {
      const int node = here.first_new_ + static_cast<int>(k);
      const auto a = partner.find(here.ends_[k][0]), b = partner.find(here.ends_[k][1]);
      if (a != partner.end() && b != partner.end() && !partner.count(node)) sought.push_back({node, a->second, b->second});
    }
    bool any = false, looked = false;
    std::unordered_set<std::uint64_t> edges;
    for (const auto& [node, a, b] : sought) {
      const auto split = there.split_.find(edge_key(a, b));
      int other = split == there.split_.end() ? -1 : split->second;
      if (other < 0) {
        if (!looked) edges = edges_of(there);
        looked = true;
        if (!edges.count(edge_key(a, b))) continue;
        other = there.midpoint(a, b);
        any = true;
      }
      partner.emplace(node, other);
      inverse.emplace(other, node);
    }
    return any;
  }

  static std::unordered_set<std::uint64_t> edges_of(const Bisection& mesh) {
    std::unordered_set<std::uint64_t> edges;
    for (const auto& cell : mesh.cells_)
      for (int i = 0; i <= mesh.dim_; ++i)
        for (int j = i + 1; j <= mesh.dim_; ++j) edges.insert(edge_key(cell.node[i], cell.node[j]));
    return edges;
  }

  std::vector<Bisection>& meshes_;
  const std::vector<Joint>& joints_;
  Monitor& monitor_;
  std::vector<std::pair<Map, Map>> partner_;
};

std::vector<Refined> refine(const std::vector<Bisection*>& meshes, const std::vector<std::vector<int>>& cells,
                            const std::vector<Joint>& joints, Monitor& monitor) {
  std::vector<Bisection> fine;
  for (const Bisection* mesh : meshes) fine.push_back(*mesh);
  std::vector<Refined> result = Rounds(fine, joints, monitor).run(cells);
  for (std::size_t m = 0; m < meshes.size(); ++m) *meshes[m] = std::move(fine[m]);
  return result;
}

}  // namespace dotyk::mesh

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/error.hpp"
#include "mesh/facet_table.hpp"
#include "shape/design/extension.hpp"

namespace dotyk::shape {
namespace {

using Quadrilateral = std::array<int, 4>;  ///< anticlockwise

[[noreturn]] void no_grid(const scene::Part& part, const std::string& why) {
  throw InputError(text("the mesh of '", part.body->name, "' is no grid mapped from ", part.label(), " to the opposite side (", why,
                        "); the harmonic extension takes every mesh"));
}

/// Two triangles with two nodes in common, as one cell.
Quadrilateral joined(const scene::Part& part, const int* a, const int* b) {
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l)
      if (a[(k + 1) % 3] == b[(l + 2) % 3] && a[(k + 2) % 3] == b[(l + 1) % 3]) return {a[k], a[(k + 1) % 3], b[l], a[(k + 2) % 3]};
  no_grid(part, "its triangles are not pairs");
}

std::vector<Quadrilateral> quadrilaterals(const scene::Part& part) {
  const mesh::Mesh& mesh = *part.body->mesh;
  std::vector<Quadrilateral> out;
  if (mesh.element == mesh::Element::quadrilateral_q1) {
    for (int c = 0; c < mesh.cell_count(); ++c) out.push_back({mesh.cell(c)[0], mesh.cell(c)[1], mesh.cell(c)[2], mesh.cell(c)[3]});
  } else if (mesh.element == mesh::Element::triangle_p1) {
    if (mesh.cell_count() % 2 != 0) no_grid(part, "its triangles are not pairs");
    for (int c = 0; c < mesh.cell_count(); c += 2) out.push_back(joined(part, mesh.cell(c), mesh.cell(c + 1)));
  } else {
    no_grid(part, "it is in space");
  }
  return out;
}

/// Which quadrilaterals have an edge, and as which side.
struct EdgeUse {
  int cell[2] = {-1, -1}, side[2] = {-1, -1};
};

class Lines {
 public:
  explicit Lines(const scene::Part& part) : part_(part), cells_(quadrilaterals(part)), seen_(cells_.size(), 0), next_(part.body->mesh->node_count(), -1) {
    for (int c = 0; c < static_cast<int>(cells_.size()); ++c)
      for (int s = 0; s < 4; ++s) {
        EdgeUse& use = edges_[mesh::edge_key(cells_[c][s], cells_[c][(s + 1) % 4])];
        const int k = use.cell[0] < 0 ? 0 : 1;
        use.cell[k] = c;
        use.side[k] = s;
      }
    for (const mesh::Facet f : part.facets) follow(part.body->mesh->facet_node(f, 0), part.body->mesh->facet_node(f, 1));
    if (std::find(seen_.begin(), seen_.end(), 0) != seen_.end()) no_grid(part, "not all cells lie on its lines");
  }

  /// The next node of the line of a node, away from the part; -1 at its end.
  int next(int node) const { return next_[node]; }

 private:
  /// Across the column of cells that stands on an edge of the part.
  void follow(int a, int b) {
    for (int from = -1;;) {
      const auto found = edges_.find(mesh::edge_key(a, b));
      if (found == edges_.end()) no_grid(part_, "its triangles are not pairs");
      const EdgeUse& use = found->second;
      const int k = use.cell[0] == from ? 1 : 0;
      if (use.cell[k] < 0) return;
      from = use.cell[k];
      if (seen_[from]++) no_grid(part_, "its lines cross");
      const Quadrilateral& q = cells_[from];
      const int s = use.side[k];
      join(q[s], q[(s + 3) % 4]);
      join(q[(s + 1) % 4], q[(s + 2) % 4]);
      a = q[(s + 2) % 4];
      b = q[(s + 3) % 4];
    }
  }

  void join(int node, int further) {
    if (next_[node] >= 0 && next_[node] != further) no_grid(part_, "its lines branch");
    next_[node] = further;
  }

  const scene::Part& part_;
  std::vector<Quadrilateral> cells_;
  std::vector<char> seen_;
  std::vector<int> next_;
  std::unordered_map<std::uint64_t, EdgeUse> edges_;
};

}  // namespace

std::vector<std::vector<double>> extend_along_lines(const BoundaryMotion& motion) {
  const mesh::Mesh& mesh = *motion.part.body->mesh;
  const Lines lines(motion.part);
  std::vector<std::vector<double>> velocities(motion.variables(), std::vector<double>(mesh.coordinates.size(), 0.0));
  for (std::size_t a = 0; a < motion.nodes.size(); ++a) {
    std::vector<int> line{motion.nodes[a]};
    std::vector<double> length{0};
    for (int to = lines.next(line.back()); to >= 0; to = lines.next(to)) {
      length.push_back(length.back() + std::hypot(mesh.node(to)[0] - mesh.node(line.back())[0], mesh.node(to)[1] - mesh.node(line.back())[1]));
      line.push_back(to);
    }
    for (std::size_t k = 0; k < line.size(); ++k)
      for (int v = 0; v < motion.variables(); ++v)
        for (int i = 0; i < 2; ++i)
          velocities[v][static_cast<std::size_t>(line[k]) * 2 + i] = motion.velocity(a, v)[i] * (1 - length[k] / length.back());
  }
  return velocities;
}

}  // namespace dotyk::shape

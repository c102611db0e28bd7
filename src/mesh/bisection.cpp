#include "mesh/bisection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "base/error.hpp"
#include "mesh/facet_table.hpp"

namespace dotyk::mesh {
namespace {

constexpr std::size_t kWatched = 4096;  // cells between two looks at the monitor

/// The node of a simplex that its facet `local` does not have.
int opposite(const ElementTopology& t, int local) {
  int sum = t.nodes * (t.nodes - 1) / 2;
  for (int k = 0; k < t.nodes_per_facet; ++k) sum -= t.facet_nodes[local][k];
  return sum;
}

/// Length and direction of an edge, rounded so that equal ones compare equal wherever they lie: the length to 1e-8
/// of itself, the direction to 1e-6, its first component that is not 0 positive.
std::array<long long, 4> order_key(const Mesh& mesh, int a, int b) {
  double d[3] = {0, 0, 0}, square = 0;
  for (int i = 0; i < mesh.dimension(); ++i) {
    d[i] = mesh.node(b)[i] - mesh.node(a)[i];
    square += d[i] * d[i];
  }
  std::array<long long, 4> key{std::llround(1e8 * std::log(square)), 0, 0, 0};
  for (int i = 0; i < 3; ++i) key[i + 1] = std::llround(1e6 * d[i] / std::sqrt(square));
  const auto first = std::find_if(key.begin() + 1, key.end(), [](long long v) { return v != 0; });
  if (first != key.end() && *first < 0)
    for (int i = 1; i < 4; ++i) key[i] = -key[i];
  return key;
}

}  // namespace

bool Bisection::longer(int a, int b, int c, int d) const {
  return order_key(*mesh_, a, b) > order_key(*mesh_, c, d);
}

Bisection::Bisection(std::shared_ptr<const Mesh> mesh) : dim_(mesh->dimension()), mesh_(std::move(mesh)) {
  const Mesh& start = *mesh_;
  const ElementTopology& t = start.topology();
  if (t.nodes != dim_ + 1)
    throw InputError(text("the mesh is of ", t.shapes, " (", t.name, "); only simplices, element = \"P1\", are refined by bisection"));
  cells_.resize(start.cell_count());
  for (int c = 0; c < start.cell_count(); ++c) {
    std::copy_n(start.cell(c), dim_ + 1, cells_[c].node.begin());
    cells_[c].tag.fill(0);
    mark(cells_[c]);
  }
  std::map<std::pair<int, int>, std::vector<int>> parts;  // cell and node opposite
  for (const auto& [name, facets] : start.parts) {
    for (const Facet f : facets) parts[{f.cell, opposite(t, f.local)}].push_back(static_cast<int>(names_.size()));
    names_.push_back(name);
  }
  std::map<std::vector<int>, int> known{{{}, 0}};
  tags_.push_back({});
  for (const auto& [where, list] : parts) {
    const auto [found, fresh] = known.emplace(list, static_cast<int>(tags_.size()));
    if (fresh) tags_.push_back(list);
    cells_[where.first].tag[where.second] = found->second;
  }
}

/// The longest edge of the cell, and of each face of a tetrahedron.
void Bisection::mark(Cell& cell) const {
  const auto longest = [&](int without) {
    std::array<std::uint8_t, 2> best{255, 255};
    for (std::uint8_t i = 0; i <= dim_; ++i)
      for (std::uint8_t j = i + 1; j <= dim_; ++j) {
        if (i == without || j == without) continue;
        if (best[0] == 255 || longer(cell.node[i], cell.node[j], cell.node[best[0]], cell.node[best[1]])) best = {i, j};
      }
    return best;
  };
  cell.edge = longest(-1);
  if (dim_ == 3)
    for (int k = 0; k < 4; ++k) cell.face[k] = longest(k);
}

/// Type P: the marked edges of the two faces that the refinement edge is not of lie with it in one face.
bool Bisection::planar(const Cell& cell) const {
  const int a = cell.edge[0], b = cell.edge[1];
  const auto other_end = [](const std::array<std::uint8_t, 2>& edge, int from) {
    return edge[0] == from ? edge[1] : edge[1] == from ? edge[0] : -1;
  };
  const int at_b = other_end(cell.face[a], b), at_a = other_end(cell.face[b], a);
  return at_a >= 0 && at_a == at_b;
}

int Bisection::midpoint(int a, int b) {
  const auto [found, fresh] = split_.emplace(edge_key(a, b), static_cast<int>(coordinates_.size()) / dim_);
  if (!fresh) return found->second;
  for (int i = 0; i < dim_; ++i)
    coordinates_.push_back(0.5 * coordinates_[static_cast<std::size_t>(a) * dim_ + i] +
                           0.5 * coordinates_[static_cast<std::size_t>(b) * dim_ + i]);
  ends_.push_back({a, b});
  return found->second;
}

bool Bisection::hangs(const Cell& cell) const {
  for (int i = 0; i <= dim_; ++i)
    for (int j = i + 1; j <= dim_; ++j)
      if (split_.count(edge_key(cell.node[i], cell.node[j]))) return true;
  return false;
}

/// The half of a cell that keeps the end `kept` of the refinement edge; the new node takes the place of the other end.
Bisection::Cell Bisection::child(const Cell& cell, int kept, int replaced, int node) const {
  Cell half = cell;
  half.node[replaced] = node;
  half.tag[kept] = 0;
  if (half.wanted > 0) --half.wanted;
  std::uint8_t rest[2];
  int count = 0;
  for (std::uint8_t k = 0; k <= dim_; ++k)
    if (k != kept && k != replaced) rest[count++] = k;
  const auto a = static_cast<std::uint8_t>(kept), m = static_cast<std::uint8_t>(replaced);
  if (dim_ == 2) {
    half.edge = {a, rest[0]};
    return half;
  }
  const bool planar = this->planar(cell);
  half.edge = cell.face[replaced];      // the inherited face lies opposite the new node
  half.face[rest[0]] = {a, rest[1]};    // cut faces: the edge opposite the new node
  half.face[rest[1]] = {a, rest[0]};
  half.face[kept] = {rest[0], rest[1]};
  if (planar && cell.flag) half.face[kept] = {m, half.edge[0] == kept ? half.edge[1] : half.edge[0]};
  half.flag = planar && !cell.flag;
  return half;
}

void Bisection::bisect(int c) {
  const Cell cell = cells_[c];
  const int a = cell.edge[0], b = cell.edge[1];
  const int m = midpoint(cell.node[a], cell.node[b]);
  cells_[c] = child(cell, a, b, m);
  cells_.push_back(child(cell, b, a, m));
}

void Bisection::begin(const std::vector<int>& cells) {
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c].parent = static_cast<int>(c);
    cells_[c].wanted = 0;
  }
  for (const int c : cells) {
    if (c < 0 || c >= mesh_->cell_count())
      throw InputError(text("cell ", c + 1, " is to be refined; the mesh has cells 1 to ", mesh_->cell_count()));
    cells_[c].wanted = static_cast<std::uint8_t>(dim_);
  }
  coordinates_ = mesh_->coordinates;
  split_.clear();
  ends_.clear();
  first_new_ = mesh_->node_count();
}

/// Bisects what is wanted and what hangs, until nothing is or does. True where anything was.
bool Bisection::close(Monitor& monitor) {
  bool any = false;
  for (bool again = true; again;) {
    again = false;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (c % kWatched == 0) monitor.check();
      while (cells_[c].wanted > 0 || hangs(cells_[c])) {
        bisect(static_cast<int>(c));
        again = any = true;
      }
    }
  }
  return any;
}

Refined Bisection::end(Monitor& monitor) {
  auto fine = std::make_shared<Mesh>();
  fine->element = mesh_->element;
  fine->coordinates = std::move(coordinates_);
  const ElementTopology& t = fine->topology();
  std::vector<std::vector<Facet>> facets(names_.size());
  Refined result;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (c % kWatched == 0) monitor.check();
    fine->cells.insert(fine->cells.end(), cells_[c].node.begin(), cells_[c].node.begin() + dim_ + 1);
    for (int l = 0; l < t.facets; ++l)
      for (const int part : tags_[cells_[c].tag[opposite(t, l)]]) facets[part].push_back({static_cast<int>(c), l});
    result.parent.push_back(cells_[c].parent);
  }
  for (std::size_t p = 0; p < names_.size(); ++p) fine->parts[names_[p]] = std::move(facets[p]);
  mesh_ = std::move(fine);
  result.ends = std::move(ends_);
  coordinates_.clear();
  ends_.clear();
  split_.clear();
  return result;
}

void Bisection::project(const std::string& part, const std::function<Point(const Point&)>& map) {
  const auto old = mesh_;
  const auto found = old->parts.find(part);
  if (found == old->parts.end()) {
    std::string all;
    for (const std::string& name : names_) all += (all.empty() ? "" : ", ") + name;
    throw InputError(text("the mesh has no part '", part, "'; it has ", all.empty() ? "none" : all));
  }
  auto moved = std::make_shared<Mesh>(*old);
  std::vector<char> made = flag_nodes(*old, found->second);
  std::fill_n(made.begin(), first_new_, 0);
  transform(*moved, map, made);
  if (mesh_ != old) throw InputError("the meshes were refined or projected by the function that says where nodes go");
  mesh_ = std::move(moved);
}

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

#include "scene/solve/adaptive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace dotyk::scene {

Adaptive::Adaptive(const std::vector<std::shared_ptr<const mesh::Mesh>>& meshes) {
  if (meshes.empty()) throw InputError("no mesh is given");
  for (const auto& mesh : meshes) {
    mesh::check(*mesh, "the mesh to be refined");
    meshes_.emplace_back(mesh);
  }
}

int Adaptive::mesh_of(const Body& body) const {
  for (int m = 0; m < count(); ++m)
    if (meshes_[m].mesh() == body.mesh) return m;
  return -1;
}

std::vector<mesh::Joint> Adaptive::joints(const Solution& solution) const {
  const Scene& scene = solution.scene();
  std::vector<mesh::Joint> result;
  for (const auto& contact : scene.contacts) {
    if (!contact->second.body || contact->pairing != contact::Pairing::matching) continue;
    const int first = mesh_of(*contact->first.body), second = mesh_of(*contact->second.body);
    if (first < 0 && second < 0) continue;
    if (first < 0 || second < 0)
      throw InputError(text("the ", contact->name, " needs matching nodes, but only the mesh of '",
                            (first < 0 ? contact->second : contact->first).body->name, "' is refined; refine both"));
    mesh::Joint joint{first, second, {}};
    for (const auto& row : contact->rows) joint.nodes.emplace_back(row.node, row.partners.front().node);
    for (const auto& tie : contact->glued) joint.nodes.emplace_back(tie.node, tie.partners.front().node);
    result.push_back(std::move(joint));
  }
  return result;
}

std::vector<mesh::Refined> Adaptive::apply(const std::vector<std::vector<int>>& cells, const std::vector<mesh::Joint>& joints,
                                           Monitor& monitor) {
  std::vector<mesh::Bisection*> all;
  for (mesh::Bisection& mesh : meshes_) all.push_back(&mesh);
  return mesh::refine(all, cells, joints, monitor);
}

int Adaptive::refine(const Solution& solution, double share, Monitor& monitor) {
  const ErrorEstimate& estimate = solution.error_estimate();
  if (!(share > 0) || !(share <= 1)) throw InputError(text("the share of the error to be refined is ", share, "; it must be in (0, 1]"));
  struct Entry {
    double square;
    int mesh, cell;
  };
  std::vector<Entry> entries;
  double whole = 0;
  bool any = false;
  for (std::size_t b = 0; b < solution.scene().bodies.size(); ++b) {
    const int m = mesh_of(solution.body(static_cast<int>(b)));
    any = any || m >= 0;
    const double least = m >= 0 ? std::pow(1e-9 * mesh(m)->size(), mesh(m)->dimension()) : 0;
    for (std::size_t c = 0; m >= 0 && c < estimate.cells[b].size(); ++c) {
      if (mesh::least_jacobian(*mesh(m), static_cast<int>(c)) < least) continue;
      entries.push_back({estimate.cells[b][c].sum(), m, static_cast<int>(c)});
      whole += entries.back().square;
    }
  }
  if (!any)
    throw InputError("no body of the solution has one of the meshes being refined, as it is now; make the bodies from these meshes, without "
                     "mesh:transform or mesh:keep");
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.square > b.square; });
  std::vector<std::vector<int>> cells(meshes_.size());
  double sum = 0;
  int marked = 0;
  for (const Entry& entry : entries) {
    if (sum >= share * whole) break;
    sum += entry.square;
    cells[entry.mesh].push_back(entry.cell);
    ++marked;
  }
  apply(cells, joints(solution), monitor);
  return marked;
}

void Adaptive::refine(const std::vector<std::vector<int>>& cells, Monitor& monitor) {
  if (static_cast<int>(cells.size()) != count())
    throw InputError(text(cells.size(), " lists of cells are given for ", count(), count() == 1 ? " mesh" : " meshes", "; give one a mesh"));
  apply(cells, {}, monitor);
}

void Adaptive::refine(Monitor& monitor) {
  std::vector<std::vector<int>> cells(meshes_.size());
  for (int m = 0; m < count(); ++m) {
    cells[m].resize(mesh(m)->cell_count());
    std::iota(cells[m].begin(), cells[m].end(), 0);
  }
  apply(cells, {}, monitor);
}

void Adaptive::project(const std::string& part, const std::function<mesh::Point(const mesh::Point&)>& map) {
  bool any = false;
  for (mesh::Bisection& mesh : meshes_) {
    if (!mesh.mesh()->parts.count(part)) continue;
    any = true;
    mesh.project(part, map);
  }
  if (!any) throw InputError(text("no mesh being refined has a part '", part, "'"));
}

}  // namespace dotyk::scene

#pragma once

#include <memory>
#include <vector>

#include "mesh/bisection.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// Meshes that are refined where solutions on them err.
class Adaptive {
 public:
  /// Throws InputError for none, and where the cells are not simplices.
  explicit Adaptive(const std::vector<std::shared_ptr<const mesh::Mesh>>& meshes);

  int count() const { return static_cast<int>(meshes_.size()); }
  std::shared_ptr<const mesh::Mesh> mesh(int index) const { return meshes_[index].mesh(); }

  /// Bisects the cells of least number whose squared estimates make up `share` of all (Dörfler 1996, share = θ): bodies
  /// whose mesh is one of these take part, others stay as they are; so do cells smaller than 1e-9 of their mesh, which
  /// a stronger singularity than elasticity has would ask for. Surfaces in contact or glued go on matching. Returns
  /// how many cells were marked. Throws InputError where no body has one of the meshes as it is now, where one is joined to a body that does not
  /// take part, and for a share outside (0, 1].
  int refine(const Solution& solution, double share, Monitor& monitor);
  /// Bisects these cells, a list a mesh.
  void refine(const std::vector<std::vector<int>>& cells, Monitor& monitor);
  /// Bisects all cells.
  void refine(Monitor& monitor);
  // All three throw as mesh::refine, and then leave the meshes as they were.
  /// See mesh::Bisection::project: of every mesh that has the part. Throws InputError where none has.
  void project(const std::string& part, const std::function<mesh::Point(const mesh::Point&)>& map);

 private:
  int mesh_of(const Body& body) const;
  std::vector<mesh::Joint> joints(const Solution& solution) const;
  std::vector<mesh::Refined> apply(const std::vector<std::vector<int>>& cells, const std::vector<mesh::Joint>& joints,
                                   Monitor& monitor);
  std::vector<mesh::Bisection> meshes_;
};

}  // namespace dotyk::scene

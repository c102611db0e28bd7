#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/statement/scene.hpp"

namespace dotyk::scene {

/// A step of a quasi-static history: what it changes of the loading of the step before it.
struct Step {
  std::optional<double> all;              ///< factor of every load and prescribed displacement
  std::map<std::string, double> factor;   ///< of those of one load case
  /// Displacements of rigid shapes, from where they were when the contact was made.
  std::vector<std::pair<std::shared_ptr<const Contact>, mesh::Point>> move;
};

/// What is applied to a scene: the factors of its loads and prescribed displacements (1 to begin
/// with), and the displacements of its rigid shapes, taken as small: normals stay as they are at rest.
struct Loading {
  double all = 1;                        ///< of what is of no case, and of the cases not in `factor`
  std::map<std::string, double> factor;  ///< by load case
  std::map<int, mesh::Point> move;       ///< by contact (index in the scene)

  double of(const std::string& load_case) const;
  mesh::Point move_of(int contact) const;
  /// Throws InputError for a load case that the scene does not have, and for a move of a contact that
  /// is not of the scene or not with a rigid shape.
  void take(const Step& step, const Scene& scene);
  /// The body with its loads and prescribed displacements so scaled, all of no case.
  Body applied_to(const Body& body) const;
  /// The contact with what its laws prescribe so scaled.
  std::shared_ptr<const Contact> applied_to(const std::shared_ptr<const Contact>& contact) const;
};

/// The names of the load cases of a scene, each once.
std::vector<std::string> load_cases(const Scene& scene);

}  // namespace dotyk::scene

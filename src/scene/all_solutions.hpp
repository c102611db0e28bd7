#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/solution.hpp"

namespace dotyk::scene {

/// Every solution of a scene in the plane with few contact nodes, by enumeration (solver/enumeration.hpp): with
/// Coulomb friction of a great coefficient there may be several, or none.
struct AllSolutions {
  std::vector<std::shared_ptr<Solution>> solutions;
  std::string summary;
};
AllSolutions all_solutions(std::shared_ptr<const Scene> scene, Monitor& monitor);

}  // namespace dotyk::scene

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// Every solution of a scene in the plane with few contact nodes, by enumeration (solver/pieces/enumeration.hpp): with
/// Coulomb friction of a great coefficient there may be several, a continuum of them, or none.
struct AllSolutions {
  struct Family {
    int dimension;
    std::vector<int> ends;  ///< places in `solutions`
    bool unbounded, forces_only;
    int continuum;  ///< which connected set it is a part of, from 0
  };
  std::vector<std::shared_ptr<Solution>> solutions;  ///< the isolated ones, then the ends of families
  std::vector<Family> families;
  std::string summary;
};
AllSolutions all_solutions(std::shared_ptr<const Scene> scene, Monitor& monitor);

}  // namespace dotyk::scene

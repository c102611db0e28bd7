#pragma once

#include <vector>

#include "elasticity/assembly.hpp"
#include "mesh/submesh.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Some cells of a body with all that their stiffness is made of. Used while a model is built.
struct Piece {
  int body = 0;
  mesh::Submesh part;
  elasticity::MaterialField material;            ///< of its own cells
  std::vector<elasticity::FacetSpring> springs;  ///< on facets of its own cells, in its matrix
  std::vector<elasticity::FacetSpring> row_springs;  ///< the same where supports are rows
  /// Of its own components: all unknown where supports are rows, else as the body's; values are in the body's alone.
  elasticity::Numbering numbering;
};

/// The pieces of all bodies of the model, body by body, each connected through facets; pieces without an unknown are
/// left out. None where the decomposition changes nothing: one piece a body, supports in the matrices.
std::vector<Piece> pieces(const Model& model, const problem::Decomposition& decomposition);

}  // namespace dotyk::scene

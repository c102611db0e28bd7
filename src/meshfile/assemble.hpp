#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "meshfile/contents.hpp"

namespace dotyk::meshfile {

struct Loaded {
  mesh::Mesh mesh;
  std::vector<std::string> regions;  ///< that the cells are of, sorted
  std::vector<std::string> notes;    ///< what the file has and the mesh has not, each a sentence
};

struct Choice {
  std::vector<std::string> regions = {};  ///< none: all cells
  int order = 1;                          ///< of the cells, 1 or 2
};

/// The mesh of the cells (elements of the greatest dimension, 2 or 3) that are in one of the regions chosen, or of all cells
/// where none is. Nodes keep their order; those that belong to none of these cells are left out.
///
/// Of order 1, elements of higher order are reduced to their corners. Of order 2, corners come first, then the nodes
/// between them (see with_nodes_between()): those of the file, or what its elements' own interpolation has there.
///
/// Groups of one dimension less become boundary parts; of their elements, those between two of the cells and those of
/// none of the cells are left out, and noted where all cells were asked for. Plane meshes lose a z that is constant.
/// Cells are turned over where their nodes are in clockwise (left-handed) order; an element that comes twice counts once.
///
/// Throws InputError, beginning with `what`: no cells; a region that is not there; cells of several shapes, or of one
/// without elements here (prisms, pyramids), or of order above 2 where 2 is asked for; a surface in space; node numbers that do not exist; cells on the same
/// side of a common facet (they overlap); what mesh::check refuses.
Loaded assemble(const Contents& contents, const Choice& choice, const std::string& what);

}  // namespace dotyk::meshfile

#pragma once

#include "base/monitor.hpp"
#include "mesh/generators.hpp"

namespace dotyk::mesh {

/// The same cells of order 2, straight: the mesh's nodes, then one in the middle of each edge, quadrilateral face and
/// tensor cell. Parts stay. A mesh of order 2 is returned as it is.
/// `watch` is asked again and again whether to stop. If so, Interrupted is thrown.
Mesh second_order(Mesh mesh, Monitor* watch = nullptr);

/// second_order() where the family is of that order, else the mesh.
Mesh of_family(Mesh first, Family family);

/// The same nodes as corners of cells of order 1: each cell of order 2 cut into 4 in the plane, 8 in space, facets of
/// parts likewise; piece k of cell c is cell pieces·c + k. Tetrahedra are cut along the shortest diagonal of the
/// octahedron in them. To draw: a curved side is drawn as two straight ones. A mesh of order 1 is returned as it is.
Mesh cut_at_nodes(Mesh mesh);

}  // namespace dotyk::mesh

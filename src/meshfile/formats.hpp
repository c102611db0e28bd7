#pragma once

#include <string>
#include <string_view>

#include "meshfile/contents.hpp"

namespace dotyk::meshfile {

/// Reads Gmsh's MSH format, versions 2.0 to 2.2, 4.0 and 4.1, text or binary, from the whole file: groups are the physical
/// groups; an element is of those that the file says it is of itself (version 2), or its entity (version 4). See Gmsh's
/// reference manual, "Gmsh file formats".
///
/// Throws InputError, beginning with `what` and the line: not such a file, another version, or what stands there does not
/// make nodes and elements: numbers of them that are not those the file says, nodes that are not there or there twice, types
/// of elements that are not known.
Contents read_msh(std::string_view all, const std::string& what);

/// A mesh in MFEM's text format "MFEM mesh v1.0" (mfem.org, "Mesh formats"): sections dimension, elements, boundary,
/// vertices; lines "attribute type vertices…". Attributes of elements become regions, those of the boundary parts,
/// named by their numbers. In place of coordinates a section "nodes" may stand, if continuous and of order 1 or 2: curved meshes.
/// Throws InputError, beginning with `what`, where that is not what the text is.
Contents read_mfem(std::string_view text, const std::string& what);

}  // namespace dotyk::meshfile

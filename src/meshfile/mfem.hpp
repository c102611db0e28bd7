#pragma once

#include <string>
#include <string_view>

#include "meshfile/contents.hpp"

namespace dotyk::meshfile {

/// A mesh in MFEM's text format "MFEM mesh v1.0" (mfem.org, "Mesh formats"): sections dimension, elements, boundary,
/// vertices; lines "attribute type vertices…". Attributes of elements become regions, those of the boundary parts,
/// named by their numbers. In place of coordinates a section "nodes" may stand, if continuous and of order 1 or 2: curved meshes.
/// Throws InputError, beginning with `what`, where that is not what the text is.
Contents read_mfem(std::string_view text, const std::string& what);

}  // namespace dotyk::meshfile

#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "meshfile/contents.hpp"

namespace dotyk::meshfile {

/// The mesh, without parts, of these blocks' elements, as cells of this order (1 or 2); see assemble() for what becomes of
/// them and what is refused. `number` gets the new numbers of the contents' nodes that are corners, -1 for others.
mesh::Mesh mesh_of(const Contents& contents, const std::vector<const Block*>& blocks, int order, std::vector<int>& number, const std::string& what);

/// "'a', 'b', 'c'", no more than a dozen.
template <class Names>
std::string list(const Names& names) {
  std::string out;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > 12) return out + " and " + std::to_string(names.size() - 12) + " more";
    out += (count > 1 ? ", '" : "'") + name + "'";
  }
  return out.empty() ? "none" : out;
}

}  // namespace dotyk::meshfile

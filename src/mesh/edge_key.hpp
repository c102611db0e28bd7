#pragma once

#include <algorithm>
#include <cstdint>

namespace dotyk::mesh {

/// One number for an edge, whichever end comes first.
inline std::uint64_t edge_key(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)), high = static_cast<std::uint64_t>(std::max(a, b));
  return low << 32 | high;
}

}  // namespace dotyk::mesh

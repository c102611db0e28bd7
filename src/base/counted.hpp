#pragma once

#include <cstddef>
#include <limits>

#include "base/error.hpp"

namespace dotyk {

/// So many entries as an int, in which indices of matrices, messages of MPI and graphs of METIS are counted. Throws InputError where there are more.
inline int counted(std::size_t entries) {
  constexpr int kMost = std::numeric_limits<int>::max();
  if (entries > static_cast<std::size_t>(kMost))
    throw InputError(text("a matrix, graph or message of ", entries, " entries: ", kMost, " are the most in one process; take fewer cells, or more ranks"));
  return static_cast<int>(entries);
}

}  // namespace dotyk

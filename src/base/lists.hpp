#pragma once

#include <vector>

namespace dotyk {

/// Lists of integers and of real numbers: what one process sends to another.
struct Lists {
  std::vector<std::vector<int>> whole;
  std::vector<std::vector<double>> real;
};

/// What one process assembles its rows of a matrix from.
struct Share {
  Lists lists;
  std::vector<int> unknowns;  ///< of the whole matrix, ascending: the unknowns of the matrix that is assembled from the lists
};

}  // namespace dotyk

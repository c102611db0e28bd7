#pragma once

#include <vector>

namespace dotyk {

/// Lists of numbers: what one process sends to another.
struct Lists {
  std::vector<std::vector<int>> whole;
  std::vector<std::vector<double>> real;
};

}  // namespace dotyk

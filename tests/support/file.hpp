#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace dotyk::test {

/// What is in a file; nothing where it cannot be read.
inline std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace dotyk::test

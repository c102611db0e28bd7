#include "fclib/read.hpp"

#include <cstring>
#include <fstream>

#include "base/readable_file.hpp"

namespace dotyk::fclib {

ContactProblem read(const std::string& file, Monitor& monitor) {
  char start[8] = {};
  require_readable(file);
  std::ifstream in(file, std::ios::binary);
  in.read(start, sizeof start);
  const bool hdf5 = in.gcount() == 8 && std::memcmp(start, "\x89HDF\r\n\x1a\n", 8) == 0;
  in.close();
  ContactProblem problem = hdf5 ? read_hdf5(file, monitor) : read_text(file);
  const auto slash = file.find_last_of('/');
  problem.name = file.substr(slash == std::string::npos ? 0 : slash + 1);
  check(problem);
  if (problem.kind == ContactProblem::Kind::global) condense(problem, monitor);
  return problem;
}

}  // namespace dotyk::fclib

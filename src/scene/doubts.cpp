#include "scene/doubts.hpp"

namespace dotyk::scene {

std::vector<std::string> doubts(const Scene&) {
  std::vector<std::string> all;
  return all;
}

std::string describe(const std::vector<std::string>& doubts) {
  std::string out;
  for (const std::string& one : doubts) out += "\n  warning: " + one;
  return out;
}

}  // namespace dotyk::scene

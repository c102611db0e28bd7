#pragma once

#include <deque>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace dotyk {

/// Where opening the file would lead: an absolute name without links. Not std::filesystem::weakly_canonical: that leaves a
/// link to a file that is not yet there as it is, and writing would make that file. Throws std::runtime_error.
inline std::filesystem::path place_of(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  const auto whole = fs::absolute(file).relative_path();
  std::deque<fs::path> steps(whole.begin(), whole.end());
  fs::path place = "/";
  for (int links = 0; !steps.empty();) {
    const auto step = steps.front();
    steps.pop_front();
    if (step.empty() || step == ".") continue;
    if (step == "..") {
      place = place.parent_path();
      continue;
    }
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(place / step, error))) {
      place /= step;
      continue;
    }
    if (++links > 40) throw std::runtime_error("'" + file.string() + "' has too many symbolic links on its way");
    const auto target = fs::read_symlink(place / step);
    if (target.is_absolute()) place = "/";
    const auto rest = target.relative_path();
    steps.insert(steps.begin(), rest.begin(), rest.end());
  }
  return place;
}

}  // namespace dotyk

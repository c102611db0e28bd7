#include "script/folder.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

namespace dotyk::script {
namespace {

namespace fs = std::filesystem;

// Where opening the file would lead. Not fs::weakly_canonical: that leaves a link to a file that is
// not yet there as it is, and writing would make that file.
fs::path place_of(const fs::path& file) {
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

}  // namespace

Folder::Folder(const std::string& name) : name_(name), place_(name.empty() ? fs::path() : place_of(name)) {
  if (name.empty() || !fs::is_directory(place_)) throw std::runtime_error("'" + name + "' is not a folder");
}

void Folder::require(const std::string& file) const {
  const auto place = place_of(file);
  const auto [end, rest] = std::mismatch(place_.begin(), place_.end(), place.begin(), place.end());
  if (end == place_.end() && rest != place.end()) return;
  throw std::runtime_error("'" + file + "' is not below '" + name_ + "', the folder of this run (--safe)");
}

}  // namespace dotyk::script

#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/error.hpp"

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

/// A folder that files must not lie outside of.
class Folder {
 public:
  /// Throws std::runtime_error where there is no such folder.
  explicit Folder(const std::string& name) : name_(name), place_(name.empty() ? std::filesystem::path() : place_of(name)) {
    if (name.empty() || !std::filesystem::is_directory(place_)) throw std::runtime_error("'" + name + "' is not a folder");
  }

  /// Absolute, without links.
  const std::filesystem::path& place() const { return place_; }

  /// Throws std::runtime_error naming file and folder unless the file, which need not exist, lies below the folder once its
  /// "." and ".." and every symbolic link on its way, to nowhere too, are followed.
  void require(const std::string& file) const {
    const auto place = place_of(file);
    const auto [end, rest] = std::mismatch(place_.begin(), place_.end(), place.begin(), place.end());
    if (end == place_.end() && rest != place.end()) return;
    throw std::runtime_error("'" + file + "' is not below '" + name_ + "', the folder of this run (--safe)");
  }

 private:
  std::string name_;  // as given
  std::filesystem::path place_;
};

/// Throws InputError, saying why, where this is not a regular file that can be read and holds something. Opening anything
/// else (a pipe) could wait for ever.
inline void require_readable(const std::string& file) {
  if (file.find('\0') != std::string::npos) throw InputError("the file name has a zero byte in it");
  struct stat info {};
  const auto fail = [&](const std::string& why) { throw InputError("cannot read '" + file + "': " + why); };
  if (stat(file.c_str(), &info) != 0) fail(std::strerror(errno));
  if (S_ISDIR(info.st_mode)) fail("it is a folder");
  if (!S_ISREG(info.st_mode)) fail("it is not a file");
  if (access(file.c_str(), R_OK) != 0) fail(std::strerror(errno));
  if (info.st_size == 0) fail("it is empty");
}

}  // namespace dotyk

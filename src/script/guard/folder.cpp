#include "script/guard/folder.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/place.hpp"

namespace dotyk::script {
namespace fs = std::filesystem;

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

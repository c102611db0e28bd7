#pragma once
// A folder that files must not lie outside of.
#include <filesystem>
#include <string>

namespace dotyk::script {

class Folder {
 public:
  // Throws std::runtime_error where there is no such folder.
  explicit Folder(const std::string& name);

  // Throws std::runtime_error naming file and folder unless the file, which need not exist, lies below
  // the folder once its "." and ".." and every symbolic link on its way, to nowhere too, are followed.
  void require(const std::string& file) const;

 private:
  std::string name_;             // as given
  std::filesystem::path place_;  // without links
};

}  // namespace dotyk::script

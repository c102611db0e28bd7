#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "fclib/contact_problem.hpp"

// Problems of ../shared/reference/fclib, read where they lie; tests skip, saying so, where they are absent.

namespace reference {

inline std::string folder() { return std::string(DOTYK_TEST_DIR) + "/../../../shared/reference/fclib/"; }

/// False, with a message, where the folder is absent.
inline bool present() {
  const bool there = std::filesystem::is_directory(folder());
  if (!there) MESSAGE("skipped: no " << folder());
  return there;
}

/// The file, or empty (with a message) where this dotyk was built without HDF5.
inline bool read(const std::string& name, dotyk::fclib::ContactProblem& problem) {
  dotyk::Monitor quiet;
  try {
    problem = dotyk::fclib::read(folder() + name, quiet);
    return true;
  } catch (const dotyk::InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    MESSAGE("skipped: " << error.what());
    return false;
  }
}

inline std::vector<std::string> files(const std::string& sub) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder() + sub))
    if (const auto ending = entry.path().extension(); ending == ".dat" || ending == ".hdf5")
      names.push_back(sub + entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace reference

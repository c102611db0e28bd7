#pragma once

#include <dlfcn.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "base/memory.hpp"

namespace dotyk {

/// A shared library of this program that is opened at first use: linked to what it needs, the program would start slowly.
struct SharedLibrary {
  std::string file;     ///< "libdotyk_….so"
  std::string what;     ///< "the drawing library"
  double bytes = 0;     ///< of address space that it takes
  std::string libdir;   ///< where it is installed, seen from the installation's root
  std::string built;    ///< where the build has put it; empty: nowhere
};

/// The first place that has the library, or the places where it is not, one a line.
struct LibraryPlace {
  std::string found;
  std::string tried;
};

/// Where a file of this program's own may be: beside it, in the library folder of its installation, where the build has put it.
inline std::vector<std::string> places_of(const std::string& file, const std::string& libdir, const std::string& built) {
  std::error_code none;
  const std::string here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path().string() + "/";
  std::vector<std::string> places{here + file, here + "../lib/dotyk/" + file, here + "../" + libdir + "/dotyk/" + file};
  if (!built.empty()) places.push_back(built);
  return places;
}

inline LibraryPlace look_for(const SharedLibrary& library) {
  LibraryPlace result;
  for (const std::string& place : places_of(library.file, library.libdir, library.built)) {
    if (access(place.c_str(), R_OK) == 0) return {place, ""};
    result.tried += "\n  not at " + place;
  }
  return result;
}

/// Opens what look_for() found, or returns it if it is open already.
inline void* open_library(const SharedLibrary& library, const std::string& place) {
  if (void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD)) return handle;  // an open library needs no more address space
  require_address_space(library.bytes, library.what);
  if (void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  const char* reason = dlerror();
  for (const char* short_of : {"failed to map", "cannot allocate", "Cannot allocate"})
    if (reason && std::strstr(reason, short_of)) throw std::runtime_error("out of memory: " + library.what + " takes more than there is left");
  throw std::runtime_error("cannot open " + library.what + " " + place + ": " + (reason ? reason : "unknown reason"));
}

}  // namespace dotyk

#pragma once

#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <cstring>
#include <stdexcept>
#include <string>
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

namespace detail {

inline std::string program_folder() {
  char path[PATH_MAX];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path);
  const std::string program(path, n > 0 ? static_cast<std::size_t>(n) : 0);
  return program.substr(0, program.rfind('/') == std::string::npos ? 0 : program.rfind('/'));
}

}  // namespace detail

inline LibraryPlace look_for(const SharedLibrary& library) {
  const std::string here = detail::program_folder();
  std::vector<std::string> places = {here + "/" + library.file, here + "/../lib/dotyk/" + library.file,
                                     here + "/../" + library.libdir + "/dotyk/" + library.file};
  if (!library.built.empty()) places.push_back(library.built);
  LibraryPlace result;
  for (const std::string& place : places) {
    if (access(place.c_str(), R_OK) == 0) return {place, ""};
    result.tried += "\n  not at " + place;
  }
  return result;
}

/// Opens what look_for() found.
inline void* open_library(const SharedLibrary& library, const std::string& place) {
  require_address_space(library.bytes, library.what);
  if (void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  const char* reason = dlerror();
  for (const char* short_of : {"failed to map", "cannot allocate", "Cannot allocate"})
    if (reason && std::strstr(reason, short_of)) throw std::runtime_error("out of memory: " + library.what + " takes more than there is left");
  throw std::runtime_error("cannot open " + library.what + " " + place + ": " + (reason ? reason : "unknown reason"));
}

}  // namespace dotyk

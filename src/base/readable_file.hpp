#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "base/error.hpp"

namespace dotyk {

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

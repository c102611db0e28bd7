#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "base/error.hpp"

namespace dotyk {

/// Writes a text file whole or not at all: beside its place first, then renamed into it.
/// Throws InputError naming the file and the reason.
inline void write_whole_file(const std::string& file, const std::string& content) {
  if (file.empty()) throw InputError("a file name is needed");
  const std::string beside = file + ".part-" + std::to_string(::getpid());
  const auto fail = [&](int reason) {
    std::remove(beside.c_str());
    throw InputError("cannot write '" + file + "': " + std::strerror(reason));
  };
  std::FILE* out = std::fopen(beside.c_str(), "wb");
  if (!out) throw InputError("cannot write '" + file + "': " + std::strerror(errno));
  const bool written = std::fwrite(content.data(), 1, content.size(), out) == content.size();
  const int reason = errno;
  if (std::fclose(out) != 0) fail(errno);
  if (!written) fail(reason);
  if (std::rename(beside.c_str(), file.c_str()) != 0) fail(errno);
}

}  // namespace dotyk

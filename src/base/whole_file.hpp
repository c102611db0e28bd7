#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "base/place.hpp"

namespace dotyk {

namespace detail {

/// What stands there, in words; null for a file.
inline const char* no_file(mode_t mode) {
  if (S_ISREG(mode)) return nullptr;
  return S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

}  // namespace detail

/// The name under which a result is to be written: the file's own, or where it leads as a symbolic link, so that the link
/// stays. Throws InputError where something is there that is no file: to put one in its place would take away a device; and
/// where its folder is not there or cannot be written. Asked of a file before what it is to hold is computed.
inline std::string place_to_write(const std::string& file) {
  if (file.empty()) throw InputError("a file name is needed");
  const auto fail = [&](const std::string& why) { throw InputError("cannot write '" + file + "': " + why); };
  struct stat info {};
  const bool link = lstat(file.c_str(), &info) == 0 && S_ISLNK(info.st_mode);
  std::string place = link ? place_of(file).string() : file;
  for (const char* system : {"/dev/", "/proc/"})
    if (link && file.rfind(system, 0) == 0) fail("it leads to what is open already; results are written to files");
  if (stat(file.c_str(), &info) == 0)
    if (const char* kind = detail::no_file(info.st_mode)) fail((link ? "it leads to '" + place + "', " : std::string("it is ")) + kind + "; results are written to files");
  const auto above = std::filesystem::path(place).parent_path().string();
  const std::string folder = above.empty() ? "." : above;
  if (stat(folder.c_str(), &info) != 0)
    fail("folder " + folder + ": " + std::strerror(errno) + (errno == ENOENT ? "; it must be there first: mkdir -p " + folder : ""));
  if (!S_ISDIR(info.st_mode)) fail(folder + " is not a folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail("folder " + folder + ": " + std::strerror(errno));
  return place;
}

/// While it lives, a signal that ends the program removes this file first. It guards one file at a time; a second one is
/// not guarded. Ignored signals stay ignored. Handlers of other signals stay in place, except those of the time limits,
/// which end the program, and of SIGINT: once its handler has restored SIG_DFL, the program is about to end.
class RemovedAtEnd {
 public:
  explicit RemovedAtEnd(const std::string& file) {
    if (*name_ || file.size() >= sizeof name_) return;
    std::memcpy(name_, file.c_str(), file.size() + 1);
    mine_ = true;
    for (int k = 0; k < kCount; ++k) {
      noted_[k] = false;
      if (sigaction(kSignals[k], nullptr, &before_[k]) != 0 || before_[k].sa_handler == SIG_IGN) continue;
      if (before_[k].sa_handler != SIG_DFL && k >= kHandled) continue;
      struct sigaction action {};
      action.sa_handler = end;
      sigfillset(&action.sa_mask);
      noted_[k] = sigaction(kSignals[k], &action, nullptr) == 0;
    }
  }
  ~RemovedAtEnd() {
    if (!mine_) return;
    for (int k = 0; k < kCount; ++k)
      if (noted_[k]) sigaction(kSignals[k], &before_[k], nullptr);
    *name_ = 0;
  }
  RemovedAtEnd(const RemovedAtEnd&) = delete;
  RemovedAtEnd& operator=(const RemovedAtEnd&) = delete;

 private:
  static void end(int signal) {
    const int reason = errno;
    int k = 0;
    while (kSignals[k] != signal) ++k;
    struct sigaction now = before_[k];
    if (signal == SIGINT && now.sa_handler != SIG_DFL) {
      now.sa_handler(signal);
      sigaction(signal, nullptr, &now);
    } else {
      sigaction(signal, &before_[k], nullptr);
      raise(signal);  // comes when this returns
    }
    if (now.sa_handler != end) unlink(name_);
    errno = reason;
  }

  static constexpr int kSignals[] = {SIGINT, SIGXCPU, SIGALRM, SIGTERM, SIGHUP, SIGQUIT}, kHandled = 3, kCount = 6;
  static inline char name_[PATH_MAX] = "";
  static inline struct sigaction before_[kCount] = {};
  static inline bool noted_[kCount] = {};
  bool mine_ = false;
};

/// Bytes that may still be written, to all files together; infinite without a limit (--files). The drawing library has
/// one of its own, which the program passes it and reads again.
inline double file_bytes_left = INFINITY;
constexpr double kLeastFileBytes = 4096;  ///< that a file takes of a disk, besides those written

/// Takes so many of them. Throws InputError where fewer are left.
inline void count_file_bytes(double bytes) {
  if (bytes > file_bytes_left) throw InputError("the limit of the bytes of all files together is reached (--files)");
  file_bytes_left -= bytes;
}

/// A result that is written whole or not at all: beside its place first, then renamed into it. What was there stays until
/// then. Gone if it is never finished, also where a signal ends the program. Throws InputError naming file and reason.
class PartFile {
 public:
  explicit PartFile(const std::string& file)
      : file_(file), place_(place_to_write(file)), part_(place_ + ".part-" + std::to_string(getpid())), at_end_(part_) {
    unlink(part_.c_str());  // of a process of this number that was killed; and no link is followed
    out_ = open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (out_ < 0) fail(std::strerror(errno));
    struct stat before {};
    if (stat(place_.c_str(), &before) == 0) fchmod(out_, before.st_mode & 07777);  // as it was; where that may not be, as new files are
  }
  ~PartFile() {
    if (out_ >= 0) close(out_);
    if (!done_) unlink(part_.c_str());
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// An empty file, for those who write it themselves.
  const std::string& name() const { return part_; }

  void write(const void* bytes, std::size_t size) {
    for (const char* at = static_cast<const char*>(bytes); size > 0;) {
      const ssize_t n = ::write(out_, at, size);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(std::strerror(errno));
      at += n, size -= static_cast<std::size_t>(n);
    }
  }
  void finish() {
    struct stat info {};
    if (std::isfinite(file_bytes_left) && stat(part_.c_str(), &info) == 0)
      count_file_bytes(kLeastFileBytes + static_cast<double>(info.st_size));
    const int out = out_;
    out_ = -1;
    if (close(out) != 0 || std::rename(part_.c_str(), place_.c_str()) != 0) fail(std::strerror(errno));
    done_ = true;
  }
  [[noreturn]] void fail(const std::string& reason) const { throw InputError("cannot write '" + file_ + "': " + reason); }

 private:
  std::string file_, place_, part_;
  RemovedAtEnd at_end_;
  int out_ = -1;
  bool done_ = false;
};

/// Throws InputError naming the file and the reason.
inline void write_whole_file(const std::string& file, const std::string& content) {
  PartFile part(file);
  part.write(content.data(), content.size());
  part.finish();
}

}  // namespace dotyk

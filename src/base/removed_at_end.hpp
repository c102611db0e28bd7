#pragma once

#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <string>

namespace dotyk {

/// While it lives, a signal that asks the program to end (SIGTERM, SIGHUP, SIGQUIT, the end of processors' time) removes
/// this file first. One at a time: of a second one nothing is noted. Signals that are ignored, or that somebody else
/// handles, stay as they are.
class RemovedAtEnd {
 public:
  explicit RemovedAtEnd(const std::string& file) {
    if (*name_ || file.size() >= sizeof name_) return;
    std::memcpy(name_, file.c_str(), file.size() + 1);
    mine_ = true;
    for (int k = 0; k < kCount; ++k) {
      noted_[k] = false;
      // Of those who handle it, the limit of processors' time is the one that ends the program.
      if (sigaction(kSignals[k], nullptr, &before_[k]) != 0 || before_[k].sa_handler == SIG_IGN) continue;
      if (before_[k].sa_handler != SIG_DFL && kSignals[k] != SIGXCPU) continue;
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
    unlink(name_);
    for (int k = 0; k < kCount; ++k)
      if (kSignals[k] == signal) sigaction(signal, &before_[k], nullptr);
    raise(signal);  // comes when this returns
    errno = reason;
  }

  static constexpr int kSignals[] = {SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}, kCount = 4;
  static inline char name_[PATH_MAX] = "";
  static inline struct sigaction before_[kCount] = {};
  static inline bool noted_[kCount] = {};
  bool mine_ = false;
};

}  // namespace dotyk

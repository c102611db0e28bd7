#pragma once

#include <sys/types.h>

namespace dotyk::reader {

/// The limit of processors' time of this process (--seconds, ulimit -t) is one for it and the programs that it starts together.
/// Each of these functions ends this process as the limit does (SIGXCPU) where that time is spent.

/// To be called from time to time while the program runs, so that it gets no more than what is left.
void count_running(pid_t program);

/// To be called when a program has ended and been waited for: what it took is no longer this process's.
void count_ended();

}  // namespace dotyk::reader

// Ends the processes that work together when one of them dies.
#pragma once

#include <sys/types.h>

#include <string>
#include <thread>
#include <vector>

namespace dotyk::multigrid {

/// A process that others wait for.
struct Companion {
  pid_t process;
  std::string name;  ///< "rank 2 of 4"
};

/// While it lives, MPI starts other processes for this one: children of Open MPI's daemon, which is a child of this process. Where one of them dies the daemon
/// ends all of them, and MPI_Comm_spawn would wait for ever; then this process ends, with a message and status 1. It does so, too, where none is there after a minute.
class StartWatch {
 public:
  StartWatch();

 private:
  std::jthread thread_;
};

/// From now on this process ends, with status 1, as soon as one of the companions ends, and takes the others with it; it says so where `speaks`.
/// mpirun does this for those that it has started; MPI by itself would wait for the dead. Only on this machine.
void watch_for_death(std::vector<Companion> companions, bool speaks);
/// They may end now.
void stop_watching();

}  // namespace dotyk::multigrid

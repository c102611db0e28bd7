// Ends the processes that work together when one of them dies.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace dotyk::multigrid {

/// A process that others wait for.
struct Companion {
  pid_t process;
  std::string name;  ///< "rank 2 of 4"
};

/// From now on this process ends, with status 1, as soon as one of the companions ends, and takes the others with it; it says so where `speaks`.
/// mpirun does this for those that it has started; MPI by itself would wait for the dead. Only on this machine.
void watch_for_death(std::vector<Companion> companions, bool speaks);
/// They may end now.
void stop_watching();

}  // namespace dotyk::multigrid

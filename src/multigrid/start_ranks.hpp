// One script, many processes: rank 0 runs it, the others work for its solvers.
#pragma once

#include <cstdlib>

#include "multigrid/slices.hpp"

namespace dotyk::multigrid {

/// Which of the processes that mpirun started this is, and how many there are: 0 where it was not mpirun.
struct RankAmong {
  int rank = 0, ranks = 0;
};
inline RankAmong rank_by_mpirun() {
  const auto number = [](const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
  };
  return {number("OMPI_COMM_WORLD_RANK", 0), number("OMPI_COMM_WORLD_SIZE", 0)};
}

/// For ranks other than 0: works until rank 0 ends. A failure on one rank ends the program on all, with a message and status 1. `spawned`: by
/// start_ranks(), else by mpirun. `makers` make the rows of slices. All these functions throw InputError where the library was not built.
void work_for_rank_0(bool spawned, const ShareMakers& makers);
/// For rank 0 under mpirun: meets the others, and lets them go when the program ends, also by std::exit.
void meet_ranks();

/// Says that this program, started with the word --worker, calls work_for_rank_0(true, …).
void take_word_worker();
/// Starts other processes of this program on this machine, so that there are `ranks`. Throws InputError where the program does not take the word, where MPI
/// cannot start them, after the first solution by multigrid, and where it has already started another number of ranks. Does nothing under mpirun.
void start_ranks(int ranks);
int count_ranks();

}  // namespace dotyk::multigrid

#include "multigrid/workers.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <sstream>

#include "base/text.hpp"
#include "multigrid/cycle/cycle.hpp"
#include "multigrid/processes/death_watch.hpp"
#include "multigrid/rank_slices.hpp"

namespace dotyk::multigrid {

namespace {

/// All processes that MPI has brought together; null: those that mpirun started.
MPI_Comm& spawned_world() {
  static MPI_Comm comm = MPI_COMM_NULL;
  return comm;
}

/// Between rank 0 and those that it has spawned.
MPI_Comm& meeting() {
  static MPI_Comm comm = MPI_COMM_NULL;
  return comm;
}

/// Ends the run where ranks that mpirun has started are different builds, as may happen across machines: their messages would not match.
void require_same_program(const Ranks& ranks) {
  constexpr int kExact = 53;  // bits that a double holds exactly
  Dl_info library{};
  dladdr(reinterpret_cast<const void*>(&require_same_program), &library);
  std::size_t builds = 0;
  for (const char* name : {"/proc/self/exe", library.dli_fname}) {
    std::ostringstream bytes;
    bytes << std::ifstream(name, std::ios::binary).rdbuf();
    builds = 31 * builds + std::hash<std::string>{}(bytes.str());
  }
  const auto own = static_cast<double>(builds >> (64 - kExact));
  const double greatest = ranks.greatest(own), least = -ranks.greatest(-own);
  if (greatest == least) return;
  if (ranks.own() == 0) ranks.abort("the ranks are different builds of dotyk");
  MPI_Barrier(ranks.comm());  // until that ends this one
}

/// All processes. The communicator is our own, so that PETSc's messages are not taken for ours.
const Ranks& world() {
  static const Ranks ranks = [] {
    start_petsc();
    MPI_Comm own = spawned_world();
    const bool by_mpirun = own == MPI_COMM_NULL;
    if (by_mpirun) MPI_Comm_dup(MPI_COMM_WORLD, &own);
    const Ranks all(own);
    if (by_mpirun && !all.alone()) all.together([&] { require_same_program(all); });
    return all;
  }();
  return ranks;
}

/// Both sides of spawn_workers(), once they have met.
void join(MPI_Comm others, bool spawned) {
  meeting() = others;
  MPI_Intercomm_merge(others, spawned, &spawned_world());
  const Ranks& all = world();
  int own = getpid();
  std::vector<int> processes(static_cast<std::size_t>(all.count()));
  MPI_Allgather(&own, 1, MPI_INT, processes.data(), 1, MPI_INT, all.comm());
  std::vector<Companion> companions;
  for (int r = spawned ? 0 : 1; r < (spawned ? 1 : all.count()); ++r) companions.push_back({processes[r], text("rank ", r, " of ", all.count())});
  watch_for_death(std::move(companions), !spawned);
}

/// Solvers and slices that live, on rank 0.
int& living() {
  static int count = 0;
  return count;
}

/// Throws where there is no memory for what MPI keeps of messages that wait: MPI would ask again for ever.
void require_room_for_messages() {
  constexpr std::size_t kRoom = 8'000'000;  // bytes
  void* volatile room = std::malloc(kRoom);
  if (!room) throw std::bad_alloc();
  std::free(room);
}

/// The next task and the number of what it is for. MPI would keep a processor busy with waiting.
std::vector<int> next_task() {
  constexpr int kShortest = 50, kLongest = 2000;  // microseconds
  int there = 0;
  for (int wait = kShortest; MPI_Iprobe(0, MPI_ANY_TAG, world().comm(), &there, MPI_STATUS_IGNORE), !there; wait = std::min(kLongest, wait + wait / 50 + 1))
    require_room_for_messages(), usleep(static_cast<useconds_t>(wait));
  return world().received<int>(0);
}

using Slices = std::map<int, std::unique_ptr<Slice>>;

std::unique_ptr<Cycle> make(Slices& slices) {
  Piece piece = receive_piece(world(), 0);
  if (piece.slices) take_matrix(piece, *slices.at(piece.slices));
  const int coarser = piece.coarser;
  auto cycle = std::make_unique<Cycle>(world(), std::move(piece));
  if (HalfRows rows = cycle->take_coarser(); coarser) slices[coarser] = receive_rest(world(), std::move(rows), without_first(cycle->functions()), cycle->coarser_load());
  return cycle;
}

using Vectors = std::map<int, algebra::VectorParts>;

void solve(Cycle& cycle, Vectors& vectors) {
  const std::vector<int> which = world().received<int>(0);
  const std::vector<double> ending = world().received<double>(0);
  algebra::VectorParts& own = vectors.at(which[0]);
  cycle.solve(own[which[1]], ending[0], ending[1], nullptr, own[which[2]], own[which[3]]);
}

void interpolate(Cycle& cycle, Vectors& vectors) {
  const std::vector<int> which = world().received<int>(0);
  cycle.interpolate(vectors.at(which[0])[which[1]], vectors.at(which[2])[which[3]]);
}

void multiply(Slice& slice, Vectors& vectors) {
  const std::vector<int> which = world().received<int>(0);
  slice.multiply(static_cast<Slice::Product>(which[1]), vectors.at(which[0]), {which[2], which[3], which[4]});
}

/// Where solvers still live, as when a script ends by os.exit, PETSc cannot be ended: MPI alone is.
void finalise(bool clean) {
  if (meeting() != MPI_COMM_NULL) MPI_Comm_disconnect(&meeting());
  if (clean) PetscFinalize();
  else MPI_Finalize();
}

int next_number() {
  static int last = 0;
  return ++last;
}

}  // namespace

bool several_ranks_have_work(double unknowns) { return ranks_now() > 1 && unknowns >= kFewestUnknowns * ranks_now(); }

Workers workers_for(double unknowns) { return {several_ranks_have_work(unknowns) ? world() : Ranks(MPI_COMM_SELF), next_number()}; }

Workers Workers::next() const { return {ranks_, next_number()}; }

void Workers::tell(Task task) const {
  if (task == Task::drop || task == Task::drop_slice) --living();
  for (int r = 1; r < ranks_.count(); ++r) tell(task, r);
}

void Workers::tell(Task task, int rank) const { ranks_.send(rank, std::vector<int>{static_cast<int>(task), number_}); }

void spawn_workers(int ranks, const std::string& program) {
  if (petsc_started())
    throw InputError("MPI can start other processes only once, and before anything else uses it: dotyk.ranks(…) comes before the first solution by multigrid");
  start_petsc(true);
  MPI_Comm others = MPI_COMM_NULL;
  MPI_Info here = MPI_INFO_NULL;  // on this machine, whatever a list of hosts says
  char host[MPI_MAX_PROCESSOR_NAME + 1] = {};
  int length = 0;
  MPI_Get_processor_name(host, &length);
  MPI_Info_create(&here);
  MPI_Info_set(here, "host", text(host, ":", ranks).c_str());
  char word[] = "--worker";
  char* words[] = {word, nullptr};
  MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN);
  const StartWatch watch;
  const int code = MPI_Comm_spawn(program.c_str(), words, ranks - 1, here, 0, MPI_COMM_SELF, &others, MPI_ERRCODES_IGNORE);
  MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_ARE_FATAL);
  MPI_Info_free(&here);
  if (code != MPI_SUCCESS) throw InputError(text("MPI could not start ", ranks - 1, " more processes of ", program));
  join(others, false);
}

void meet_workers() { world(); }

int ranks_now() { return petsc_started() ? world().count() : 1; }

void Workers::made() const { ++living(); }

void work(bool spawned, const ShareMakers& makers) {
  if (spawned) {
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for rank 0, which has the terminal
    start_petsc(true);
    MPI_Comm parent = MPI_COMM_NULL;
    MPI_Comm_get_parent(&parent);
    if (parent == MPI_COMM_NULL) throw InputError("--worker is for processes that dotyk.ranks(…) starts");
    join(parent, true);
  }
  std::map<int, std::unique_ptr<Cycle>> cycles;  // outlive an exception: PETSc may crash where it destroys a solver that failed, before the reason is told
  Slices slices;
  Vectors vectors;
  world().together([&] {
    for (;;) {
      const std::vector<int> order = next_task();
      const int number = order[1];
      switch (static_cast<Task>(order[0])) {
        case Task::make: cycles[number] = make(slices); break;
        case Task::set: cycles.at(number)->set(receive_change(world(), 0)); break;
        case Task::solve: solve(*cycles.at(number), vectors); break;
        case Task::interpolate: interpolate(*cycles.at(number), vectors); break;
        case Task::drop: cycles.erase(number); break;
        case Task::slice: slices[number] = receive_slice(world(), makers); break;
        case Task::refined_slice: slices[number] = receive_refined_slice(world(), makers); break;
        case Task::visit: visit_for_rank_0(world(), makers, vectors.at(number)); break;
        case Task::multiply: multiply(*slices.at(number), vectors); break;
        case Task::some: tell_some(world(), *slices.at(number)); break;
        case Task::drop_slice: slices.erase(number); break;
        case Task::vectors: vectors.insert_or_assign(number, receive_vectors(world())); break;
        case Task::order: run_order(world(), vectors.at(number)); break;
        case Task::get:
        case Task::put:
        case Task::get_some:
        case Task::set_some: exchange_numbers(world(), static_cast<Task>(order[0]), vectors.at(number)); break;
        case Task::drop_vectors: vectors.erase(number); break;
        case Task::end:
          stop_watching();
          if (!number)
            for (auto& [of, cycle] : cycles) static_cast<void>(cycle.release());
          finalise(number != 0);
          return;
      }
    }
  });
}

void end_workers() {
  const bool clean = living() == 0;
  stop_watching();
  for (int r = 1; r < world().count(); ++r) world().send(r, std::vector<int>{static_cast<int>(Task::end), clean});
  finalise(clean);
}

}  // namespace dotyk::multigrid

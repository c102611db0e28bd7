// Opens the library with PETSc when the first slices or the first solver are made: linked to it, the program would start its MPI as well.
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "algebra/direct/blas_threads.hpp"
#include "base/open_library.hpp"
#include "multigrid/multigrid.hpp"

namespace dotyk::multigrid {

namespace {

const SharedLibrary& petsc() {
  static const SharedLibrary library = [] {
    SharedLibrary l{"libdotyk_multigrid_petsc.so", "the library of multigrid", 400e6, DOTYK_MULTIGRID_LIBDIR, ""};
#ifdef DOTYK_MULTIGRID_BUILD_LIBRARY
    l.built = DOTYK_MULTIGRID_BUILD_LIBRARY;
#endif
    return l;
  }();
  return library;
}

std::atomic<bool> is_open{false};     // the library
std::atomic<bool> takes_word{false};  // the program: --worker
std::atomic<bool> have_met{false};    // ranks that mpirun started

/// A function of the library, which is opened for it.
template <class Function>
Function* door(const char* name) {
  const LibraryPlace place = look_for(petsc());
  if (place.found.empty())
    throw Unavailable("multigrid, and work on several ranks, need PETSc's library: install it (apt-get install --no-install-recommends "
                     "libpetsc-real-dev; ./dotyk --setup-only does) and build again");
  algebra::reserve_blas_buffer();  // PETSc's aggregates need it: a rank that does not get it would ask for ever, and all others wait
  try {
    const auto function = reinterpret_cast<Function*>(dlsym(open_library(petsc(), place.found), name));
    if (!function) throw std::runtime_error(petsc().what + " is of another version of dotyk");
    is_open = true;
    return function;
  } catch (const std::exception& error) {
    throw Unavailable(error.what());
  }
}

void end_at_exit() {
  static void (*const end)() = door<void()>("dotyk_multigrid_end_ranks");
  std::atexit([] { end(); });
}

}  // namespace

std::unique_ptr<algebra::SpdSolver> make_solver(const Matrix& matrix, Monitor& monitor) {
  static const auto make = door<algebra::SpdSolver*(const Matrix&, Monitor&)>("dotyk_multigrid_solver");
  return std::unique_ptr<algebra::SpdSolver>(make(matrix, monitor));
}

bool slices_pay_for(double unknowns) {
  constexpr double kMany = 50'000;  // for one process
  return count_ranks() == 1 ? unknowns >= kMany && available() : door<bool(double)>("dotyk_multigrid_share")(unknowns);
}

bool starts() {
  try {
    door<void()>("dotyk_multigrid_start")();
    return true;
  } catch (const Unavailable&) {
    return false;
  }
}

std::shared_ptr<const algebra::SlicedMatrix> make_slices(const Shared& matrix) {
  return std::shared_ptr<const algebra::SlicedMatrix>(door<algebra::SlicedMatrix*(const Shared&)>("dotyk_multigrid_slices")(matrix));
}

std::shared_ptr<const algebra::SlicedMatrix> make_refined_slices(const Refined& matrix) {
  return std::shared_ptr<const algebra::SlicedMatrix>(door<algebra::SlicedMatrix*(const Refined&)>("dotyk_multigrid_refined_slices")(matrix));
}

std::vector<Lists> visit(const Visit& visit) {
  std::vector<Lists> told;
  door<void(const Visit&, std::vector<Lists>&)>("dotyk_multigrid_visit")(visit, told);
  return told;
}

void work_for_rank_0(bool spawned, const ShareMakers& makers) { door<void(bool, const ShareMakers&)>("dotyk_multigrid_work")(spawned, makers); }

void meet_ranks() {
  door<void()>("dotyk_multigrid_meet")();
  end_at_exit();
  have_met = true;
}

int count_ranks() {
  if (!is_open) return 1;
  static int (*const count)() = door<int()>("dotyk_multigrid_ranks");
  return count();
}

void take_word_worker() { takes_word = true; }

void start_ranks(int ranks) {
  const int there = count_ranks();
  if (ranks == there || have_met) return;
  if (!takes_word) throw InputError("only the program dotyk starts other processes of its own");
  if (there > 1) throw InputError(text("there are ", there, " ranks already; their number stays as it is"));
  door<void(int, const char*)>("dotyk_multigrid_spawn")(ranks, std::filesystem::read_symlink("/proc/self/exe").c_str());
  end_at_exit();
}

bool available() { return !look_for(petsc()).found.empty(); }
double bytes_to_open() { return is_open ? 0 : petsc().bytes; }

}  // namespace dotyk::multigrid

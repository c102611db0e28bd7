#include "multigrid/processes/petsc_session.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>

#include "multigrid/multigrid.hpp"

namespace dotyk::multigrid {

namespace {

std::string& last_error() {
  static std::string words;
  return words;
}

/// Instead of PETSc's, which print to standard error. The first call has the words, the others follow the stack upwards.
PetscErrorCode note_error(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type, const char* words, void*) {
  if (type == PETSC_ERROR_INITIAL) last_error() = std::string(words ? words : "") + " (in " + (function ? function : "") + ")";
  return code;
}

/// Signal handlers as they were, and no signal for the threads that are started meanwhile.
class KeptSignals {
 public:
  KeptSignals() {
    for (int s = 1; s < kEnd; ++s) known_[s] = sigaction(s, nullptr, &actions_[s]) == 0;
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &mask_);
  }
  ~KeptSignals() {
    for (int s = 1; s < kEnd; ++s)
      if (known_[s] && s != SIGKILL && s != SIGSTOP) sigaction(s, &actions_[s], nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }

 private:
  static constexpr int kEnd = 32;
  struct sigaction actions_[kEnd];
  bool known_[kEnd];
  sigset_t mask_;
};

/// Sets variables of the environment while MPI starts, but none that the user has set. Afterwards they are removed, and so are those that MPI has set itself: a
/// program that a script starts, such as mpirun, would take itself for one of these ranks.
class Environment {
 public:
  Environment() : known_(variables()) {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}) known_.erase(name);
  }
  void set(const char* name, const char* value) {
    if (setenv(name, value, 0) == 0) names_.emplace(name);
  }
  ~Environment() {
    for (const std::string& name : variables())
      if (!known_.contains(name) && (names_.contains(name) || is_of_mpi(name))) unsetenv(name.c_str());
  }

 private:
  static std::set<std::string> variables() {
    std::set<std::string> names;
    for (char** one = environ; *one; ++one) names.emplace(*one, std::strcspn(*one, "="));
    return names;
  }
  static bool is_of_mpi(const std::string& name) {
    return std::ranges::any_of(std::array{"OMPI_", "ORTE_", "OPAL_", "PMIX_"}, [&](const char* start) { return name.starts_with(start); });
  }

  std::set<std::string> known_, names_;
};

void initialise(bool spawns) {
  const KeptSignals signals;
  Environment environment;
  if (spawns) {  // in containers too: as root, and more ranks than processors
    environment.set("OMPI_ALLOW_RUN_AS_ROOT", "1");
    environment.set("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
    environment.set("OMPI_MCA_rmaps_base_oversubscribe", "1");
    environment.set("OMPI_MCA_mpi_yield_when_idle", "1");
    environment.set("OMPI_MCA_plm_rsh_agent", "false");  // needs no ssh, and looks for none
  } else if (rank_by_mpirun().ranks == 0) {  // a process of its own: no daemon beside it, no files, no network
    environment.set("OMPI_MCA_ess_singleton_isolated", "1");
    environment.set("OMPI_MCA_orte_create_session_dirs", "0");
    environment.set("OMPI_MCA_pml", "ob1");
    environment.set("OMPI_MCA_btl", "self");
  }
  environment.set("OMPI_MCA_opal_signal", "");             // no handlers that print stacks
  environment.set("OMPI_MCA_memory", "^patcher");  // which rewrites munmap() and others in the running program
  environment.set("OMPI_MCA_mpi_warn_on_fork", "0");
  environment.set("HWLOC_COMPONENTS", "-gl,-opencl,-cuda,-nvml,-rsmi,-levelzero,-pci");  // or it asks X servers for displays
  char program[] = "dotyk", no_files[] = "-skip_petscrc", no_handler[] = "-no_signal_handler";
  char* words[] = {program, no_files, no_handler, nullptr};
  int count = 3;
  char** arguments = words;
  PETSC_MPI_THREAD_REQUIRED = MPI_THREAD_SERIALIZED;  // calls come from any thread, one at a time
  if (PetscInitialize(&count, &arguments, nullptr, nullptr) != 0) throw Unavailable("PETSc could not be started");
  check(PetscPushErrorHandler(note_error, nullptr));
  check(PetscOptionsSetValue(nullptr, "-mat_cholmod_print", "0"));  // what is not definite is told by set()
}

}  // namespace

void start_petsc(bool spawns) {
  static const bool started = [spawns] {
    initialise(spawns);
    return true;
  }();
  static_cast<void>(started);
}

std::mutex& only_one() {
  static std::mutex mutex;
  return mutex;
}

bool petsc_started() {
  PetscBool started = PETSC_FALSE;
  return PetscInitialized(&started) == 0 && started == PETSC_TRUE;
}

void check(PetscErrorCode code) {
  if (code == 0) return;
  if (code == PETSC_ERR_MEM || last_error().find("Malloc") != std::string::npos) throw std::runtime_error("out of memory: multigrid takes more than there is left");
  throw std::runtime_error("PETSc: " + (last_error().empty() ? "error " + std::to_string(code) : last_error()));
}

}  // namespace dotyk::multigrid

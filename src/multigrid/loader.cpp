// Opens the library with PETSc when the first solver is made: linked to it, the program would start its MPI as well.
#include <dlfcn.h>

#include <exception>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/error.hpp"
#include "base/open_library.hpp"
#include "base/text.hpp"
#include "multigrid/door.hpp"

namespace dotyk::multigrid {

namespace {

const SharedLibrary& petsc() {
  static const SharedLibrary library = [] {
    SharedLibrary l{"libdotyk_multigrid_petsc.so", "the library of algebraic multigrid", 400e6, DOTYK_MULTIGRID_LIBDIR, ""};
#ifdef DOTYK_MULTIGRID_BUILD_LIBRARY
    l.built = DOTYK_MULTIGRID_BUILD_LIBRARY;
#endif
    return l;
  }();
  return library;
}

template <class Function>
void look_up(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (!function) throw std::runtime_error(petsc().what + " is of another version of dotyk");
}

const Doors& doors() {
  static const Doors opened = [] {
    const LibraryPlace place = look_for(petsc());
    if (place.found.empty())
      throw InputError("algebraic multigrid needs PETSc's library: install it (apt-get install --no-install-recommends libpetsc-real-dev; "
                       "./dotyk --setup-only does) and build again");
    void* handle = open_library(petsc(), place.found);
    Doors d;
    look_up(handle, "dotyk_multigrid_make", d.make);
    look_up(handle, "dotyk_multigrid_set", d.set);
    look_up(handle, "dotyk_multigrid_solve", d.solve);
    look_up(handle, "dotyk_multigrid_facts", d.facts);
    look_up(handle, "dotyk_multigrid_drop", d.drop);
    return d;
  }();
  return opened;
}

/// Asks the monitor for the library; what that throws is kept until the library has returned.
class Asking {
 public:
  explicit Asking(Monitor& monitor) : monitor_(monitor) {}

  const Watcher* watcher() const { return &watcher_; }

  /// Throws what `outcome` says, save that the matrix is not definite.
  void check(Outcome outcome, const Message& message) const {
    if (thrown_) std::rethrow_exception(thrown_);
    if (outcome == Outcome::stopped) throw Interrupted();
    if (outcome == Outcome::failed) throw std::runtime_error(message.text);
  }

 private:
  static bool stop(void* who) {
    Asking& self = *static_cast<Asking*>(who);
    try {
      return self.monitor_.stop();
    } catch (...) {
      self.thrown_ = std::current_exception();
      return true;
    }
  }

  Monitor& monitor_;
  std::exception_ptr thrown_;
  Watcher watcher_{stop, this};
};

class PetscSolver final : public Solver {
 public:
  PetscSolver(const Matrix& matrix, Monitor& monitor) : monitor_(monitor), unknowns_(matrix.lower.rows()) {
    const Asking asking(monitor);
    Message message;
    asking.check(doors().make(&matrix, asking.watcher(), &hierarchy_, &message), message);
  }
  ~PetscSolver() override { doors().drop(hierarchy_); }
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  bool set(const algebra::SparseMatrix& lower, const std::vector<char>& held) override {
    const Asking asking(monitor_);
    Message message;
    const Outcome outcome = doors().set(hierarchy_, &lower, &held, asking.watcher(), &message);
    asking.check(outcome, message);
    return outcome == Outcome::done;
  }

  algebra::Vector solve(const algebra::Vector& b, double tolerance) override {
    if (b.size() != unknowns_) throw std::runtime_error(text("a right-hand side of ", b.size(), " numbers for ", unknowns_, " unknowns"));
    const Asking asking(monitor_);
    Message message;
    algebra::Vector x(unknowns_);
    const Outcome outcome = doors().solve(hierarchy_, b.data(), tolerance, x.data(), asking.watcher(), &message);
    asking.check(outcome, message);
    if (outcome == Outcome::not_definite) x.setConstant(std::numeric_limits<double>::quiet_NaN());
    return x;
  }

  double bytes() const override { return facts().bytes; }
  int iterations() const override { return facts().iterations; }
  int levels() const override { return facts().levels; }
  std::string method() const override {
    const Facts f = facts();
    return text("conjugate gradients, algebraic multigrid (PETSc ", f.version, ", ", f.levels, f.levels == 1 ? " level)" : " levels)");
  }

 private:
  Facts facts() const {
    Facts f;
    doors().facts(hierarchy_, &f);
    return f;
  }

  Monitor& monitor_;
  Eigen::Index unknowns_;
  void* hierarchy_ = nullptr;
};

}  // namespace

std::unique_ptr<Solver> make_solver(const Matrix& matrix, Monitor& monitor) { return std::make_unique<PetscSolver>(matrix, monitor); }

bool available() { return !look_for(petsc()).found.empty(); }

}  // namespace dotyk::multigrid

// Opens the library with PETSc when the first solver is made: linked to it, the program would start its MPI as well.
#include <dlfcn.h>

#include <stdexcept>

#include "base/error.hpp"
#include "base/open_library.hpp"
#include "multigrid/multigrid.hpp"

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

using Door = algebra::SpdSolver*(const Matrix&, Monitor&);

Door* open_door() {
  const LibraryPlace place = look_for(petsc());
  if (place.found.empty())
    throw InputError("algebraic multigrid needs PETSc's library: install it (apt-get install --no-install-recommends libpetsc-real-dev; "
                     "./dotyk --setup-only does) and build again");
  const auto door = reinterpret_cast<Door*>(dlsym(open_library(petsc(), place.found), "dotyk_multigrid_solver"));
  if (!door) throw std::runtime_error(petsc().what + " is of another version of dotyk");
  return door;
}

}  // namespace

std::unique_ptr<algebra::SpdSolver> make_solver(const Matrix& matrix, Monitor& monitor) {
  static Door* const door = open_door();
  return std::unique_ptr<algebra::SpdSolver>(door(matrix, monitor));
}

bool available() { return !look_for(petsc()).found.empty(); }

}  // namespace dotyk::multigrid

#pragma once

#include <doctest/doctest.h>

#include "multigrid/multigrid.hpp"

namespace dotyk::test {

/// True, with a message, where the library was not built.
inline bool not_built() {
  if (multigrid::available()) return false;
  MESSAGE("left out: PETSc is absent");
  return true;
}

}  // namespace dotyk::test

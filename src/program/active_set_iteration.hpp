#pragma once

#include "program/active_set.hpp"

namespace dotyk::program {

/// A working set, point and multipliers to begin with, in the scaled program.
struct ActiveSetStart {
  std::vector<Side> working;
  Vector x, y;
};

/// The steps of the active-set method on a scaled program; see active_set.hpp for what it does.
Result iterate(const QuadraticProgram& p, const ActiveSet& settings, const ActiveSetStart& start, Monitor& monitor);

}  // namespace dotyk::program

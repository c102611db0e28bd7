#pragma once

#include <string>

#include "fclib/contact_problem.hpp"

namespace dotyk::fclib {

/// The frictional contact problem in a file: HDF5 as FCLIB writes it (groups fclib_local and fclib_global), or the
/// plain text that siconos prints (FC2D, FC3D, GFC2D, GFC3D). Which it is, is seen from its content. A global
/// problem comes condensed. Throws InputError naming the file and what is wrong with it, or why its problem is
/// not treated (rolling friction; equations beside the contacts); std::runtime_error for HDF5 where dotyk was built
/// without it.
ContactProblem read(const std::string& file, Monitor& monitor);

constexpr int kMost = 10'000'000;  ///< rows, columns, entries: beyond it a count is a mistake

/// One format each, not condensed.
ContactProblem read_hdf5(const std::string& file, Monitor& monitor);
ContactProblem read_text(const std::string& file);

}  // namespace dotyk::fclib

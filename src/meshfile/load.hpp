#pragma once

#include <string>

#include "base/monitor.hpp"
#include "meshfile/assemble.hpp"

namespace dotyk::meshfile {

/// Reads a mesh by the file's ending: .msh (Gmsh 2 and 4, text or binary), .mesh (MFEM mesh v1.0, text), .vtu (VTK, by its
/// library: cell data "region", or "body" as dotyk writes it, give the regions). See assemble() for what becomes of the contents, and for `choice`. Throws InputError naming the file, and
/// Interrupted where the monitor asks to stop.
Loaded load(const std::string& file, const Choice& choice, Monitor& monitor);

struct Meshing {
  int dimension = 0;  ///< 0: 3 where the geometry has a volume, else 2
  double size = 0;    ///< greatest edge of a cell, length; 0: as the geometry says
};

/// Has Gmsh mesh a geometry: a file that ends in .geo, .step, .stp, .brep, .iges or .igs; of order 2 with the nodes between
/// corners on its curved boundaries, too. Throws as load().
Loaded mesh_geometry(const std::string& file, const Meshing& meshing, const Choice& choice, Monitor& monitor);

/// The same of the text of a .geo file.
Loaded mesh_text(const std::string& geometry, const Meshing& meshing, const Choice& choice, Monitor& monitor);

}  // namespace dotyk::meshfile

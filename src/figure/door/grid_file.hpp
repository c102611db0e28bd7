// A mesh with values at its nodes and cells, written for ParaView: plain data,
// nothing to link but dotyk_figure.
#pragma once

#include <string>
#include <vector>

#include "figure/door/picture.hpp"

namespace dotyk::figure {

// Values at every node, one tuple a node.
struct GridArray {
  std::string name;
  std::vector<std::string> components;  // their names, one or more; names of one are not written
  std::vector<double> values;           // components × n, node by node; nan where there is none
};

// The cells of one body, as node numbers of the whole file.
struct GridBody {
  std::string name;
  CellShape shape = CellShape::triangle;
  std::vector<int> cells;               // 3, 4, 4 or 8 nodes each, of order 2 6, 9, 10 or 27; VTK order
  int order = 1;
};

struct GridFile {
  std::string file;                     // ends in .vtu; its folder must exist
  std::vector<double> points;           // 3 n: reference coordinates, of all bodies
  std::vector<GridBody> bodies;
  std::vector<GridArray> arrays;
};

// Writes VTK's XML format, the numbers compressed in binary, whole or not at
// all: on an error grid.file is as it was. Cells carry the array "body": their
// body's place in `bodies`, from 1; the text array "body_names" has the names.
// Throws std::runtime_error as draw() does.
void write(const GridFile& grid);

}  // namespace dotyk::figure

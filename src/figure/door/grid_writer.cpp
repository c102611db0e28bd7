// VTK's own XML writer, on arrays of ours.
#include <algorithm>
#include <filesystem>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "base/text.hpp"
#include "base/whole_file.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

// The array looks at our numbers, which outlive it, instead of copying them.
void look_at(vtkDoubleArray* array, const std::vector<double>& values, int components) {
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<double*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
}

unsigned char cell_type(CellShape shape, int order) {
  static constexpr unsigned char types[][2] = {{VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE}, {VTK_QUAD, VTK_BIQUADRATIC_QUAD},
                                               {VTK_TETRA, VTK_QUADRATIC_TETRA}, {VTK_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON}};
  return types[static_cast<int>(shape)][order - 1];
}

void add_cells(const GridFile& file, vtkUnstructuredGrid* grid) {
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIntArray> body;
  body->SetName("body");
  vtkNew<vtkStringArray> names;
  names->SetName("body_names");
  for (std::size_t b = 0; b < file.bodies.size(); ++b) {
    const GridBody& part = file.bodies[b];
    const int each = nodes_per_cell(part.shape, part.order);
    for (std::size_t k = 0; k < part.cells.size(); k += each) {
      cells->InsertNextCell(each);
      for (int i = 0; i < each; ++i) cells->InsertCellPoint(part.cells[k + i]);
      types->InsertNextValue(cell_type(part.shape, part.order));
      body->InsertNextValue(static_cast<int>(b) + 1);
    }
    names->InsertNextValue(part.name);
  }
  grid->SetCells(types, cells);
  grid->GetCellData()->AddArray(body);
  grid->GetFieldData()->AddArray(names);
}

// VTK's own complaints would go to standard error, past the script's error.
struct Quiet {
  const int before = vtkObject::GetGlobalWarningDisplay();
  Quiet() { vtkObject::GlobalWarningDisplayOff(); }
  ~Quiet() { vtkObject::SetGlobalWarningDisplay(before); }
};

void write_cells(const GridFile& file) {
  vtkNew<vtkDoubleArray> coordinates;
  look_at(coordinates, file.points, 3);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  add_cells(file, grid);
  for (const GridArray& given : file.arrays) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(given.name.c_str());
    look_at(array, given.values, static_cast<int>(given.components.size()));
    if (given.components.size() > 1)
      for (std::size_t c = 0; c < given.components.size(); ++c)
        array->SetComponentName(static_cast<vtkIdType>(c), given.components[c].c_str());
    grid->GetPointData()->AddArray(array);
  }

  const Quiet quiet;
  PartFile part(file.file);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->SetFileName(part.name().c_str());
  const int written = writer->Write();
  const unsigned long error = writer->GetErrorCode();
  if (!written || error != vtkErrorCode::NoError)
    part.fail(error == vtkErrorCode::NoError ? "the writer failed" : vtkErrorCode::GetStringFromErrorCode(error));
  part.finish();
}

std::size_t cells_of(const GridBody& body) { return body.cells.size() / nodes_per_cell(body.shape, body.order); }

// Every body's cells are cut into `of` parts. Part k of each body, from 0, with the nodes of its cells; cells and nodes stay in order.
GridFile share(const GridFile& whole, std::size_t k, std::size_t of, const std::string& name) {
  GridFile piece{name, {}, {}, {}};
  std::vector<int> number(whole.points.size() / 3, -1), nodes;
  for (const GridBody& body : whole.bodies) {
    const std::size_t count = cells_of(body), each = nodes_per_cell(body.shape, body.order);
    const auto cut = [&](std::size_t at) { return body.cells.begin() + static_cast<std::ptrdiff_t>(count * at / of * each); };
    piece.bodies.push_back({body.name, body.shape, {cut(k), cut(k + 1)}, body.order});
    for (const int node : piece.bodies.back().cells) number[node] = 0;
  }
  for (int node = 0; node < static_cast<int>(number.size()); ++node)
    if (number[node] == 0) number[node] = static_cast<int>(nodes.size()), nodes.push_back(node);
  for (GridBody& body : piece.bodies)
    for (int& node : body.cells) node = number[node];
  const auto pick = [&](const std::vector<double>& values, std::size_t each) {
    std::vector<double> picked;
    picked.reserve(nodes.size() * each);
    for (const int node : nodes) picked.insert(picked.end(), values.begin() + node * each, values.begin() + (node + 1) * each);
    return picked;
  };
  piece.points = pick(whole.points, 3);
  for (const GridArray& array : whole.arrays) piece.arrays.push_back({array.name, array.components, pick(array.values, array.components.size())});
  return piece;
}

// What ParaView needs to know of the pieces before it reads them.
std::string list_of(const GridFile& whole, const std::vector<std::string>& pieces) {
  std::string list = "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
                     "<PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>\n";
  for (const GridArray& array : whole.arrays) {
    list += text("<PDataArray type=\"Float64\" Name=\"", array.name, "\" NumberOfComponents=\"", array.components.size(), "\"");
    for (std::size_t c = 0; c < array.components.size() && array.components.size() > 1; ++c) list += text(" ComponentName", c, "=\"", array.components[c], "\"");
    list += "/>\n";
  }
  list += "</PPointData>\n<PCellData><PDataArray type=\"Int32\" Name=\"body\"/></PCellData>\n"
          "<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n";
  for (const std::string& piece : pieces) list += text("<Piece Source=\"", piece, "\"/>\n");
  return list + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void render(const GridFile& file) {
  const std::filesystem::path place(file.file);
  if (place.extension() != ".pvtu") return write_cells(file);
  constexpr std::size_t kMillion = 1000000;
  std::size_t cells = 0, most_pieces = 1;  // none is to be empty
  for (const GridBody& body : file.bodies) {
    cells += cells_of(body);
    most_pieces = std::max(most_pieces, cells_of(body));
  }
  const std::size_t asked = file.pieces > 0 ? file.pieces : (cells + kMillion - 1) / kMillion, pieces = std::clamp<std::size_t>(asked, 1, most_pieces);
  std::filesystem::remove(place_to_write(file.file));
  if (!file.written.empty()) return write_whole_file(file.file, list_of(file, file.written));
  std::vector<std::string> names;
  for (std::size_t k = 0; k < pieces; ++k) {
    names.push_back(text(place.stem().string(), "_", k, ".vtu"));
    const std::filesystem::path piece = place.parent_path() / names.back();
    if (std::filesystem::is_symlink(piece)) std::filesystem::remove(piece);  // it may lead to anywhere
    write_cells(share(file, k, pieces, piece.string()));
  }
  write_whole_file(file.file, list_of(file, names));
}

}  // namespace dotyk::figure

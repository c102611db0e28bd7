// VTK's own XML writer, on arrays of ours.
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

}  // namespace

void render(const GridFile& file) {
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

}  // namespace dotyk::figure

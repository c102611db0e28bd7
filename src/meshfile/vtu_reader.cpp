// Reads VTK's unstructured grids (.vtu, XML) with its own library.
//   dotyk_vtu FILE.vtu
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "contents.hpp"
#include "reader/reader_main.hpp"

namespace {

using namespace dotyk::meshfile;
using dotyk::reader::answer, dotyk::reader::limit_reader;

struct Type {
  Shape shape;
  int order;
  std::vector<int> corner{};  ///< in our order; empty: the first ones as they are
};

const Type* type_of(int vtk) {
  static const std::map<int, Type> types{{VTK_LINE, {Shape::segment, 1}},
                                         {VTK_TRIANGLE, {Shape::triangle, 1}},
                                         {VTK_QUAD, {Shape::quadrilateral, 1}},
                                         {VTK_PIXEL, {Shape::quadrilateral, 1, {0, 1, 3, 2}}},
                                         {VTK_TETRA, {Shape::tetrahedron, 1}},
                                         {VTK_HEXAHEDRON, {Shape::hexahedron, 1}},
                                         {VTK_VOXEL, {Shape::hexahedron, 1, {0, 1, 3, 2, 4, 5, 7, 6}}},
                                         {VTK_WEDGE, {Shape::prism, 1}},
                                         {VTK_PYRAMID, {Shape::pyramid, 1}},
                                         {VTK_QUADRATIC_EDGE, {Shape::segment, 2}},
                                         {VTK_QUADRATIC_TRIANGLE, {Shape::triangle, 2}},
                                         {VTK_QUADRATIC_QUAD, {Shape::quadrilateral, 2}},
                                         {VTK_BIQUADRATIC_QUAD, {Shape::quadrilateral, 2}},
                                         {VTK_QUADRATIC_TETRA, {Shape::tetrahedron, 2}},
                                         {VTK_QUADRATIC_HEXAHEDRON, {Shape::hexahedron, 2}},
                                         {VTK_TRIQUADRATIC_HEXAHEDRON, {Shape::hexahedron, 2}}};
  const auto found = types.find(vtk);
  return found == types.end() ? nullptr : &found->second;
}

/// Notes VTK's complaints, which would go to standard error.
class Complaints : public vtkCommand {
 public:
  static Complaints* New() { return new Complaints; }
  void Execute(vtkObject*, unsigned long, void* text) override {
    if (first.empty() && text) first = static_cast<const char*>(text);
  }
  /// One line, without the place in VTK's sources that it begins with.
  std::string line() const {
    std::string out = first.substr(std::min(first.find("): ") == std::string::npos ? 0 : first.find("): ") + 3, first.size()));
    while (!out.empty() && std::isspace(static_cast<unsigned char>(out.back()))) out.pop_back();
    for (char& c : out)
      if (c == '\n') c = ' ';
    return out;
  }
  std::string first;
};

/// Which region a cell is of, by a cell array "region" or "body", named by the field data "region_names" or "body_names".
struct Regions {
  explicit Regions(vtkUnstructuredGrid* grid) {
    for (const char* name : {"region", "body"}) {
      array = grid->GetCellData()->GetArray(name);
      if (array && array->GetNumberOfComponents() == 1 && array->GetNumberOfTuples() == grid->GetNumberOfCells()) {
        names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray((std::string(name) + "_names").c_str()));
        return;
      }
      array = nullptr;
    }
  }
  double of(vtkIdType cell) const { return array ? array->GetComponent(cell, 0) : 0; }
  /// Numbers with names count from 1.
  std::string name(double value) const {
    if (names && value >= 1 && value <= static_cast<double>(names->GetNumberOfValues()) && value == std::floor(value))
      return names->GetValue(static_cast<vtkIdType>(value) - 1);
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", value);
    return text;
  }
  vtkDataArray* array = nullptr;
  vtkStringArray* names = nullptr;
};

class Blocks {
 public:
  explicit Blocks(vtkUnstructuredGrid* grid) : regions_(grid) {}

  void add(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* ids) {
    const int vtk = grid->GetCellType(cell);
    if (vtk == VTK_VERTEX || vtk == VTK_POLY_VERTEX || vtk == VTK_EMPTY_CELL) return;
    const Type* type = type_of(vtk);
    if (!type) throw std::runtime_error("it has cells of VTK's type " + std::to_string(vtk) + ", for which there is no element");
    grid->GetCellPoints(cell, ids);
    const int corners = kind(type->shape).nodes;
    if (ids->GetNumberOfIds() < corners) throw std::runtime_error("cell " + std::to_string(cell + 1) + " has too few nodes");
    Block& block = block_of(*type, regions_.of(cell));
    const auto node = [&](int k) {
      const vtkIdType n = ids->GetId(k);
      if (n < 0 || n >= grid->GetNumberOfPoints()) throw std::runtime_error("cell " + std::to_string(cell + 1) + " has a node that is not there");
      return static_cast<int>(n);
    };
    for (int k = 0; k < corners; ++k) block.nodes.push_back(node(type->corner.empty() ? k : type->corner[k]));
    // VTK's order is ours; serendipity cells end with the nodes on their edges.
    const int all = type->order == 2 ? corners + static_cast<int>(between_corners(type->shape).size()) : corners;
    for (int k = corners; k < all; ++k) block.between.push_back(k < ids->GetNumberOfIds() ? node(k) : -1);
  }

  Contents contents;

 private:
  Block& block_of(const Type& type, double region) {
    if (std::isnan(region)) throw std::runtime_error("a region number is not a number");
    const auto [block, fresh] = block_of_.try_emplace({type.shape, type.order, region}, contents.blocks.size());
    if (!fresh) return contents.blocks[block->second];
    contents.blocks.push_back({type.shape, {}, {}, type.order});
    if (regions_.array) {
      contents.blocks.back().groups.push_back(static_cast<int>(contents.groups.size()));
      contents.groups.push_back({kind(type.shape).dimension, regions_.name(region)});
    }
    return contents.blocks.back();
  }

  Regions regions_;
  std::map<std::tuple<Shape, int, double>, std::size_t> block_of_;
};

Contents load(const std::string& file) {
  vtkNew<Complaints> complaints;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, complaints);
  reader->SetReaderErrorObserver(complaints);
  reader->SetParserErrorObserver(complaints);
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  if (!complaints->first.empty()) throw std::runtime_error("VTK: " + complaints->line());
  if (reader->GetErrorCode() != vtkErrorCode::NoError || !grid) throw std::runtime_error(std::string("VTK: ") + vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode()));
  if (grid->GetNumberOfPoints() > 2'000'000'000) throw std::runtime_error("it has more nodes than this program can number");
  Blocks blocks(grid);
  blocks.contents.points.resize(3 * static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) grid->GetPoint(i, &blocks.contents.points[3 * static_cast<std::size_t>(i)]);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) blocks.add(grid, c, ids);
  return std::move(blocks.contents);
}

}  // namespace

int main(int count, char** argument) {
  if (count != 2) return 2;
  limit_reader(argument[1]);
  return answer([&](std::FILE* out) { write(out, load(argument[1])); });
}

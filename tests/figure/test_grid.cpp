// The file for ParaView, read back by VTK's own reader.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>

#include "figure/compose/compose.hpp"
#include "mesh/generators.hpp"
#include "pixels.hpp"

using namespace dotyk;
using figure::GridArray;
using figure::GridFile;

namespace {

std::shared_ptr<scene::Body> block(const std::string& name, double low, mesh::Family family) {
  const double from[2] = {0, low}, to[2] = {1, low + 1};
  const int cells[2] = {3, 2};
  const mesh::Grading even[2];
  auto mesh = std::make_shared<mesh::Mesh>(mesh::rectangle(from, to, cells, family, even));
  return scene::make_body(name, mesh,
                          elasticity::MaterialField(elasticity::isotropic(10, 0.2, 2, elasticity::Plane::strain)), {});
}

/// A block of triangles pressed on one of quadrilaterals.
std::shared_ptr<scene::Solution> two_blocks() {
  auto lower = block("lower", 0, mesh::Family::q1), upper = block("upper", 1, mesh::Family::p1);
  auto held = scene::named_part(lower, "bottom"), loaded = scene::named_part(upper, "top"),
       side = scene::named_part(upper, "left");
  scene::fix(held, {true, true, true});
  scene::fix(side, {true, false, false});
  scene::load(loaded, [](const mesh::Point& x) { return mesh::Point{0, -1 - x[0], 0}; });
  const auto s = scene::make_scene({lower, upper});
  scene::add_contact(*s, scene::named_part(upper, "bottom"), scene::named_part(lower, "top"), {});
  Monitor monitor;
  return scene::solve(s, {}, {}, monitor);
}

vtkSmartPointer<vtkUnstructuredGrid> read(const std::string& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

int files_in(const std::string& folder) {
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  return files;
}

GridFile triangle(const std::string& file) {
  GridFile grid;
  grid.file = file;
  grid.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  grid.bodies = {{"wedge", figure::CellShape::triangle, {0, 1, 2}}};
  grid.arrays = {{"t", {""}, {1, 2, 3}}};
  return grid;
}

}  // namespace

TEST_CASE("a written solution is read back bit by bit") {
  const auto s = two_blocks();
  const GridFile given = figure::compose_grid(*s, "blocks.vtu");
  figure::write(given);
  const auto grid = read("blocks.vtu");
  REQUIRE(grid->GetNumberOfPoints() == 24);
  REQUIRE(grid->GetNumberOfCells() == 6 + 12);
  for (int n = 0; n < 24; ++n)
    for (int i = 0; i < 3; ++i) CHECK(grid->GetPoint(n)[i] == given.points[3 * n + i]);

  CHECK(grid->GetCellType(0) == 9);   // VTK_QUAD
  CHECK(grid->GetCellType(17) == 5);  // VTK_TRIANGLE
  CHECK(grid->GetCellData()->GetArray("body")->GetTuple1(0) == 1);
  CHECK(grid->GetCellData()->GetArray("body")->GetTuple1(17) == 2);
  const auto* names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("body_names"));
  REQUIRE(names);
  CHECK(const_cast<vtkStringArray*>(names)->GetValue(1) == "upper");
  for (int k = 0; k < 3; ++k)
    CHECK(grid->GetCell(6)->GetPointId(k) == given.bodies[1].cells[k]);

  REQUIRE(given.arrays.size() == 6);
  for (const GridArray& array : given.arrays) {
    vtkDataArray* back = grid->GetPointData()->GetArray(array.name.c_str());
    REQUIRE(back);
    const int each = back->GetNumberOfComponents();
    REQUIRE(each == static_cast<int>(array.components.size()));
    for (int n = 0; n < 24; ++n)
      for (int c = 0; c < each; ++c) {
        const double value = array.values[static_cast<std::size_t>(n) * each + c];
        if (std::isnan(value))
          CHECK(std::isnan(back->GetComponent(n, c)));
        else
          CHECK(back->GetComponent(n, c) == value);
      }
    if (each > 1) CHECK(std::string(back->GetComponentName(each - 1)) == array.components.back());
  }
}

TEST_CASE("cells of order 2 are VTK's own, nodes in its order: every one is where VTK's shape functions have it") {
  for (const mesh::Family family : {mesh::Family::p2, mesh::Family::q2})
    for (const int dim : {2, 3}) {
      const double from[3] = {0, 0, 0}, to[3] = {1, 2, 3};
      const int cells[3] = {2, 1, 1};
      const mesh::Grading even[3];
      auto mesh = std::make_shared<mesh::Mesh>(dim == 2 ? mesh::rectangle(from, to, cells, family, even) : mesh::box(from, to, cells, family, even));
      const auto body = scene::make_body("block", mesh, elasticity::MaterialField(elasticity::isotropic(10, 0.2, dim, elasticity::Plane::strain)), {});
      auto held = scene::named_part(body, "bottom"), loaded = scene::named_part(body, "top");
      scene::fix(held, {true, true, true});
      scene::load(loaded, [](const mesh::Point&) { return mesh::Point{0.1, -1, 0.2}; });
      Monitor monitor;
      figure::write(figure::compose_grid(*scene::solve(scene::make_scene({body}), {}, {}, monitor), "second.vtu"));
      const auto grid = read("second.vtu");
      REQUIRE(grid->GetNumberOfPoints() == mesh->node_count());
      REQUIRE(grid->GetNumberOfCells() == mesh->cell_count());
      const int type = family == mesh::Family::p2 ? (dim == 2 ? 22 : 24) : (dim == 2 ? 28 : 29);
      for (int c = 0; c < mesh->cell_count(); ++c) {
        CHECK(grid->GetCellType(c) == type);
        vtkCell* cell = grid->GetCell(c);
        REQUIRE(cell->GetNumberOfPoints() == mesh->topology().nodes);
        for (int k = 0; k < mesh->topology().nodes; ++k) {
          CHECK(cell->GetPointId(k) == mesh->cell(c)[k]);
          // On straight cells the map is that of the corners: where the node's parametric point is says which node it must be.
          const double* at = cell->GetParametricCoords() + 3 * k;
          for (int i = 0; i < dim; ++i) {
            double x = cell->GetPoints()->GetPoint(0)[i];
            const int next[2][3] = {{1, 2, 3}, {1, 3, 4}};  // the corners along the axes
            for (int axis = 0; axis < dim; ++axis)
              x += at[axis] * (cell->GetPoints()->GetPoint(next[family == mesh::Family::q2][axis])[i] - cell->GetPoints()->GetPoint(0)[i]);
            CHECK(cell->GetPoints()->GetPoint(k)[i] == doctest::Approx(x).epsilon(1e-14));
          }
        }
      }
    }
}

TEST_CASE("pieces of a .pvtu have all cells once, and the values of the whole at their nodes") {
  const auto s = two_blocks();
  GridFile given = figure::compose_grid(*s, "pieces.pvtu");
  given.pieces = 3;
  figure::write(given);
  vtkNew<vtkXMLPUnstructuredGridReader> reader;
  reader->SetFileName("pieces.pvtu");
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  REQUIRE(grid->GetNumberOfCells() == 6 + 12);
  for (int k = 0; k < 3; ++k) CHECK(read("pieces_" + std::to_string(k) + ".vtu")->GetNumberOfCells() == 2 + 4);
  CHECK_FALSE(std::filesystem::exists("pieces_3.vtu"));

  int next[2] = {0, 0};  // of each body's cells, which come in their order
  for (int c = 0; c < 18; ++c) {
    const int body = static_cast<int>(grid->GetCellData()->GetArray("body")->GetTuple1(c)) - 1;
    REQUIRE((body == 0 || body == 1));
    vtkCell* cell = grid->GetCell(c);
    const int each = body == 0 ? 4 : 3;
    REQUIRE(cell->GetNumberOfPoints() == each);
    for (int k = 0; k < each; ++k) {
      const int here = static_cast<int>(cell->GetPointId(k)), node = given.bodies[body].cells[next[body] * each + k];
      for (int i = 0; i < 3; ++i) CHECK(grid->GetPoint(here)[i] == given.points[3 * node + i]);
      for (const GridArray& array : given.arrays) {
        vtkDataArray* back = grid->GetPointData()->GetArray(array.name.c_str());
        REQUIRE(back);
        REQUIRE(back->GetNumberOfComponents() == static_cast<int>(array.components.size()));
        for (std::size_t i = 0; i < array.components.size(); ++i) {
          const double value = array.values[node * array.components.size() + i], found = back->GetComponent(here, static_cast<int>(i));
          CHECK((found == value || (std::isnan(found) && std::isnan(value))));
        }
        if (array.components.size() > 1) CHECK(std::string(back->GetComponentName(1)) == array.components[1]);
      }
    }
    ++next[body];
  }
  CHECK(next[0] == 6);
  CHECK(next[1] == 12);
}

TEST_CASE("more pieces than cells are one a cell; a list whose pieces cannot be written is gone") {
  GridFile grid = triangle("few.pvtu");
  grid.pieces = 5;
  figure::write(grid);
  CHECK(std::filesystem::exists("few_0.vtu"));
  CHECK_FALSE(std::filesystem::exists("few_1.vtu"));
  std::filesystem::remove("few_0.vtu");
  std::filesystem::create_directory("few_0.vtu");
  CHECK(message_of([&] { figure::write(grid); }) == "cannot write 'few_0.vtu': it is a folder; results are written to files");
  CHECK_FALSE(std::filesystem::exists("few.pvtu"));
  std::filesystem::remove("few_0.vtu");
  std::filesystem::create_symlink("elsewhere.vtu", "few_0.vtu");
  figure::write(grid);
  CHECK_FALSE(std::filesystem::is_symlink("few_0.vtu"));
  CHECK_FALSE(std::filesystem::exists("elsewhere.vtu"));
  grid.file = "few & more.pvtu";
  CHECK(message_of([&] { figure::write(grid); }) == "few & more.pvtu: the name of a .pvtu, which lists names in XML, cannot have & < > or \"");
  std::filesystem::create_directories("R & D");
  grid.file = "R & D/few.pvtu";
  figure::write(grid);
  CHECK(std::filesystem::exists("R & D/few_0.vtu"));
  grid.file = "few.vtu";
  CHECK(message_of([&] { figure::write(grid); }) == "few.vtu: pieces, one or more, are for a .pvtu");
}

TEST_CASE("the arrays are what the solution says") {
  const auto s = two_blocks();
  const GridFile grid = figure::compose_grid(*s, "x.vtu");
  const auto value = [&](const char* name, int node, int c = 0) {
    for (const GridArray& a : grid.arrays)
      if (a.name == name) return a.values[node * a.components.size() + c];
    throw std::runtime_error(name);
  };
  const int upper = 12;
  CHECK(value("displacement", upper + 5, 1) == s->displacement(1)[2 * 5 + 1]);
  CHECK(value("stress", 3, 3) == s->stress(0)[3][5]);  // xy
  CHECK(value("stress", 3, 2) == s->stress(0)[3][2]);  // zz
  CHECK(value("von_mises", 3) == elasticity::von_mises(s->stress(0)[3]));
  CHECK(value("contact_status", 0) == -1);
  CHECK(std::isnan(value("contact_gap", 0)));
  for (const auto& n : s->contact(*s->scene().contacts[0]).nodes) {
    const int below = 8 + n.node;  // the same place on top of the lower block
    for (const int node : {upper + n.node, below}) {
      CHECK(value("contact_pressure", node) == n.pressure);
      CHECK(value("contact_gap", node) == n.gap);
      CHECK(value("contact_status", node) == static_cast<int>(n.status));
    }
  }
}

TEST_CASE("the pressure of a file, integrated over the faces of cells of either order, is the contact's force") {
  for (const mesh::Family family : {mesh::Family::p1, mesh::Family::q1, mesh::Family::p2, mesh::Family::q2})
    for (const int dim : {2, 3})
      for (const bool rigid : {true, false}) {
        // A block pressed on a ball, or on another block, and tilted, so that part of it opens.
        const double from[3] = {0, 0, 0}, low[3] = {0, -1, 0}, to[3] = {1, 1, 1}, middle[3] = {1, 0, 1};
        const int cells[3] = {4, 2, 2};
        const mesh::Grading even[3];
        const auto body_of = [&](const char* name, const double* a, const double* b) {
          return scene::make_body(name, std::make_shared<mesh::Mesh>(dim == 2 ? mesh::rectangle(a, b, cells, family, even) : mesh::box(a, b, cells, family, even)),
                                  elasticity::MaterialField(elasticity::isotropic(10, 0.2, dim, elasticity::Plane::strain)), {});
        };
        const std::string low_side = dim == 2 ? "bottom" : "front", high_side = dim == 2 ? "top" : "back";  // of y
        const auto upper = body_of("upper", from, to), lower = body_of("lower", low, middle);
        auto pressed = scene::named_part(upper, high_side), held = scene::named_part(lower, low_side);
        const auto none = [](const mesh::Point&) { return 0.0; };
        scene::displace(pressed, {none, [](const mesh::Point& x) { return -0.1 + 0.15 * x[0]; }, none});
        scene::fix(held, {true, true, true});
        const auto s = rigid ? scene::make_scene({upper}) : scene::make_scene({upper, lower});
        if (rigid) scene::add_contact(*s, scene::named_part(upper, low_side), contact::RigidBall{{0.2, -1, dim == 2 ? 0. : 0.5}, 1}, {}, false);
        else scene::add_contact(*s, scene::named_part(upper, low_side), scene::named_part(lower, high_side), {});
        Monitor monitor;
        const auto solved = scene::solve(s, {}, {}, monitor);
        REQUIRE(solved->result().converged);
        const auto result = solved->contact(*s->contacts[0]);
        REQUIRE((result.open > 0 && result.closed > 0));
        figure::write(figure::compose_grid(*solved, "pressed.vtu"));
        const auto grid = read("pressed.vtu");
        vtkDataArray *pressure = grid->GetPointData()->GetArray("contact_pressure"), *status = grid->GetPointData()->GetArray("contact_status");
        double force[2] = {0, 0};  // of the upper block's faces in the plane y = 0, of the lower one's
        for (int c = 0; c < grid->GetNumberOfCells(); ++c)
          for (int f = 0; f < (dim == 2 ? grid->GetCell(c)->GetNumberOfEdges() : grid->GetCell(c)->GetNumberOfFaces()); ++f) {
            vtkCell* face = dim == 2 ? grid->GetCell(c)->GetEdge(f) : grid->GetCell(c)->GetFace(f);
            const int nodes = static_cast<int>(face->GetNumberOfPoints());
            bool there = true;
            double sum = 0, box[6];
            face->GetBounds(box);
            // ∫φ of the face's nodes, relative to its measure, and twice that measure of a triangle.
            static const std::map<int, std::vector<double>> weights{{2, {0.5, 0.5}}, {3, {1 / 6., 1 / 6., 4 / 6.}}, {4, {.25, .25, .25, .25}},
                {6, {0, 0, 0, 1 / 3., 1 / 3., 1 / 3.}}, {9, {1 / 36., 1 / 36., 1 / 36., 1 / 36., 1 / 9., 1 / 9., 1 / 9., 1 / 9., 4 / 9.}}};
            const bool triangle = dim == 3 && (nodes == 3 || nodes == 6);
            for (int k = 0; k < nodes; ++k) {
              there = there && std::abs(face->GetPoints()->GetPoint(k)[1]) < 1e-12;
              const double weight = dim == 3 && nodes == 3 ? 1 / 3. : weights.at(nodes)[static_cast<std::size_t>(k)];
              sum += weight * pressure->GetTuple1(face->GetPointId(k));
            }
            const double measure = (box[1] - box[0]) * (dim == 3 ? (box[5] - box[4]) * (triangle ? 0.5 : 1) : 1);
            const int body = static_cast<int>(grid->GetCellData()->GetArray("body")->GetTuple1(c)) - 1;
            if (there) force[body] += measure * sum;
            for (int k = 0; there && k < nodes; ++k) {
              CHECK(status->GetTuple1(face->GetPointId(k)) >= 0);
              if (pressure->GetTuple1(face->GetPointId(k)) > 0) CHECK(status->GetTuple1(face->GetPointId(k)) == 1);
            }
          }
        CAPTURE(std::to_string(static_cast<int>(family)) + (dim == 2 ? " plane" : " space") + (rigid ? " rigid" : " matching"));
        for (int body = 0; body < (rigid ? 1 : 2); ++body) CHECK(force[body] == doctest::Approx(std::abs(result.force[1])).epsilon(1e-10));
      }
}

TEST_CASE("a file that cannot be written leaves nothing, and says why") {
  using figure::write;
  CHECK(message_of([] { write(triangle("a.vtk")); }) == "cannot write a.vtk: the file name must end in .vtu or .pvtu");
  CHECK(message_of([] { write(triangle("nowhere/a.vtu")); }) ==
        "cannot write 'nowhere/a.vtu': folder nowhere: No such file or directory; it must be there first: mkdir -p nowhere");
  GridFile grid = triangle("refused.vtu");
  grid.bodies[0].cells = {0, 1, 3};
  CHECK(message_of([&] { write(grid); }) == "body \"wedge\", cells: node 3 does not exist, there are 3");
  grid = triangle("refused.vtu");
  grid.arrays[0].values.pop_back();
  CHECK(message_of([&] { write(grid); }) == "array \"t\": 2 values for 3 nodes of 1 components");
  CHECK_FALSE(std::filesystem::exists("refused.vtu"));

  // A disk that fills up, as a limit on the size of files.
  std::filesystem::remove_all("full");
  std::filesystem::create_directory("full");
  write(triangle("full/a.vtu"));
  const auto before = std::filesystem::file_size("full/a.vtu");
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit small = limit;
  small.rlim_cur = 300;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string why = message_of([] { write(triangle("full/a.vtu")); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  CHECK(why.find("cannot write 'full/a.vtu'") == 0);
  CHECK(files_in("full") == 1);
  CHECK(std::filesystem::file_size("full/a.vtu") == before);
}

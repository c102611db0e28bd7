#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "punch.hpp"

using namespace dotyk;
namespace fs = std::filesystem;

namespace {

/// An empty folder for one test, removed afterwards.
struct Scratch {
  fs::path path = fs::path("scratch-files-test");
  Scratch() { fs::remove_all(path), fs::create_directory(path); }
  ~Scratch() { fs::remove_all(path); }
  int files() const { return static_cast<int>(std::distance(fs::directory_iterator(path), fs::directory_iterator())); }
};

std::shared_ptr<scene::Solution> solved(int n) {
  Monitor quiet;
  return scene::solve(punch::plane(n).scene, {}, {}, quiet);
}

}  // namespace

TEST_CASE("write_contact: a header, one whole line a node, numbers that read back exactly") {
  Scratch scratch;
  const auto s = solved(16);
  const auto file = (scratch.path / "contact.csv").string();
  scene::write_contact(*s, file);
  CHECK(scratch.files() == 1);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  CHECK(line == "contact,node,x,y,gap,pressure,force,weight,shear_x,shear_y,slip_x,slip_y,status");
  const auto result = s->contact(*s->scene().contacts[0]);
  std::size_t row = 0;
  while (std::getline(in, line)) {
    std::stringstream cells(line);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    REQUIRE(values.size() == 13);
    REQUIRE(row < result.nodes.size());
    const auto& node = result.nodes[row++];
    CHECK(values[0] == "1");
    CHECK(std::stoi(values[1]) == node.node + 1);
    CHECK(std::stod(values[2]) == node.x[0]);
    CHECK(std::stod(values[5]) == node.pressure);
    CHECK(std::stod(values[6]) == node.force);
    CHECK(std::stod(values[7]) == node.weight);
    CHECK(std::stod(values[8]) == node.shear[0]);
    CHECK(std::stod(values[10]) == node.slip[0]);
    CHECK(std::stod(values[11]) == node.slip[1]);
    CHECK(values[12] == problem::status_name(node.status));
  }
  CHECK(row == 17);
}

TEST_CASE("write_contact replaces an older file") {
  Scratch scratch;
  const auto file = (scratch.path / "contact.csv").string();
  scene::write_contact(*solved(32), file);
  const auto larger = fs::file_size(file);
  scene::write_contact(*solved(8), file);
  CHECK(fs::file_size(file) < larger);
  CHECK(scratch.files() == 1);
}

TEST_CASE("a file that cannot be written is refused with its name, and nothing is left") {
  Scratch scratch;
  const auto s = solved(8);
  const auto missing = (scratch.path / "missing" / "contact.csv").string();
  CHECK_THROWS_WITH_AS(scene::write_contact(*s, missing), doctest::Contains(("cannot write '" + missing + "'").c_str()),
                       InputError);
  fs::create_directory(scratch.path / "folder");
  std::ofstream(scratch.path / "folder" / "inside") << "x";
  CHECK_THROWS_AS(scene::write_contact(*s, (scratch.path / "folder").string()), InputError);
  CHECK(scratch.files() == 1);  // the folder, no half file beside it
  CHECK_THROWS_AS(scene::write_contact(*s, ""), InputError);
}

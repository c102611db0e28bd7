#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "program/certificate.hpp"
#include "program/program_file.hpp"
#include "programs.hpp"

using namespace dotyk;
using program::Status;

TEST_CASE("the programs of ../shared/reference/qp: listed optimum, feasibility, both variants" * doctest::test_suite("large")) {
  const std::string folder = std::string(DOTYK_TEST_DIR) + "/../../../shared/reference/qp/";
  std::ifstream index(folder + "maros_meszaros_index.csv");
  if (!index) {
    MESSAGE("skipped: no " << folder);
    return;
  }
  Monitor quiet;
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    for (int k = 0; k < 11; ++k) std::getline(fields, field, ',');
    const double optimum = std::stod(field);
    program::QuadraticProgram p;
    try {
      p = program::read_mat(folder + "maros_meszaros/" + name + ".mat", quiet);
    } catch (const std::runtime_error& error) {
      MESSAGE("skipped: " << error.what());
      return;
    }
    for (const auto& settings : {test::one(), test::many()}) {
      const auto r = program::solve(p, settings, quiet);
      INFO(name << ": " << r.reason);
      if (name == "VALUES") {
        CHECK(r.status == Status::not_convex);
        continue;
      }
      REQUIRE(r.status == Status::solved);
      CHECK(r.residual.feasibility < 1e-6);
      const auto b = program::bracket(p, r.x, r.y);
      CHECK(b.dual <= b.primal + 1e-9 * (1 + std::abs(b.primal)) + b.slack * (1 + std::abs(b.primal)));
      // The value listed for HUES-MOD is above the optimum, which the bracket gives to 1e-10.
      if (name == "HUES-MOD") {
        CHECK(b.gap + b.slack < 1e-10);
        CHECK(optimum - b.primal > 6e-6 * b.primal);
      } else CHECK(std::abs(r.objective - optimum) <= 1e-6 * (1 + std::abs(optimum)));
    }
  }
}

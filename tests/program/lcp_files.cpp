#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "base/error.hpp"
#include "program/lcp.hpp"

using namespace dotyk;
using program::LcpStatus;

TEST_CASE("every file of ../shared/reference/lcp is solved, or said to have no solution, or more than one") {
  const std::filesystem::path folder = std::string(DOTYK_TEST_DIR) + "/../../../shared/reference/lcp";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped: no " << folder.string());
    return;
  }
  const std::map<std::string, LcpStatus> special = {
      {"lcp_CPS_1.dat", LcpStatus::several}, {"lcp_CPS_3.dat", LcpStatus::several}, {"lcp_CPS_5.dat", LcpStatus::several},
      {"lcp_Pang_isolated_sol_perturbed.dat", LcpStatus::none}, {"lcp_inf_sol_perturbed.dat", LcpStatus::several}};
  Monitor quiet;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".dat") continue;
    ++files;
    const auto lcp = program::read_lcp(entry.path());
    const auto r = program::solve(lcp, {}, quiet);
    INFO(lcp.name << ": " << r.reason);
    const auto known = special.find(lcp.name);
    CHECK(r.status == (known == special.end() ? LcpStatus::solved : known->second));
    if (r.status != LcpStatus::none) CHECK(r.residual < 1e-12);
    if (r.status == LcpStatus::several) CHECK(program::residual(lcp, r.other) < 1e-12);
  }
  CHECK(files == 20);
  // The same problem in the two storages.
  const auto dense = program::read_lcp(folder / "lcp_ortiz.dat"), blocks = program::read_lcp(folder / "lcp_ortiz_block.dat");
  CHECK((dense.M - blocks.M).norm() == 0);
  CHECK(dense.q == blocks.q);
}

TEST_CASE("files of complementarity problems that do not hold together are refused") {
  const auto refused = [](const std::string& content, const std::string& message) {
    { std::ofstream("made.dat") << content; }
    CHECK_THROWS_WITH_AS(program::read_lcp("made.dat"), message.c_str(), InputError);
  };
  refused("2 1 2 2 1 1 1 2 2 2 1 0 0 0", "'made.dat': the row index is 0; from 1 to 1 is expected");  // beyond the last row
  refused("2 1 2 2 1 1 1 2 2 2 1 1 1 0", "'made.dat': the row index is 1; from 0 to 0 is expected");
  refused("2 2", "'made.dat': the storage is 2; from 0 to 1 is expected");
  CHECK_THROWS_WITH_AS(program::read_lcp("no such file"), "cannot read 'no such file': No such file or directory", InputError);
  // No file of a few bytes asks for gigabytes.
  refused("20000 0 20000 20000 20000 20000 1", "'made.dat': it is too short for a problem of 20000 rows");
  refused("20000 1 20000 20000 1 1 1 20000 20000 2 1 0 1 0 0", "'made.dat': it is too short for a problem of 20000 rows");
}

TEST_CASE("a complementarity problem of many blocks in one row after many") {
  // Single blocks: the diagonal, and a column of the last row again and again.
  const int n = 500, more = 100000;
  std::string first = "0 ", places, values;
  for (int k = 0; k < n; ++k) {
    first += std::to_string(k < n - 1 ? k + 1 : n + more) + " ";
    places += std::to_string(k) + " ";
    values += std::to_string(k) + " 2 ";
  }
  for (int k = 0; k < more; ++k) {
    places += "7 ";
    values += std::to_string(n + k) + " 1 ";
  }
  std::string ends, q;
  for (int k = 0; k < n; ++k) ends += std::to_string(k + 1) + " ", q += "-1 ";
  const std::string size = std::to_string(n) + " ", blocks = std::to_string(n + more) + " ";
  { std::ofstream("made.dat") << size << "1 " << size << size << blocks << size << size << ends << ends << n + 1 << " " << blocks << first << places << values << q; }
  const program::Lcp lcp = program::read_lcp("made.dat");
  CHECK(lcp.M.coeff(n - 1, 7) == 1);
  CHECK(lcp.M.coeff(n - 1, n - 1) == 2);
  CHECK(lcp.M.coeff(5, 5) == 2);
}

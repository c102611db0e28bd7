#include <fstream>
#include <map>

#include "../support/file.hpp"
#include "reference.hpp"

using namespace dotyk;
using fclib::ContactProblem;

namespace {

struct Facts {
  ContactProblem::Kind kind;
  int contacts, unknowns, rank;
};
constexpr auto local = ContactProblem::Kind::local;
constexpr auto global = ContactProblem::Kind::global;

/// Reads a file of this content; the message of its refusal, empty where it is taken.
std::string refusal(const std::string& content, const std::string& name = "made.dat") {
  { std::ofstream(name, std::ios::binary) << content; }
  Monitor quiet;
  try {
    fclib::read(name, quiet);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool begins(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

constexpr const char* kOne = "3\n1\n0\n3\n3\n3\t3\n2 1 0\n 1 3 0\n 0 0 4\n -1 2 3\n 0.5\n0\n";

}  // namespace

TEST_CASE("HDF5 files: kind, sizes and the rank of W as computed independently") {
  if (!reference::present()) return;
  const std::map<std::string, Facts> expected = {
      {"local_problem_test.hdf5", {local, 48, 144, 72}},
      {"LMGC_100_PR_PerioBox-i00361-60-03000.hdf5", {local, 60, 180, 72}},
      {"Capsules-i125-1213.hdf5", {local, 286, 858, 570}},
      {"Box_Stacks-i0122-82-5.hdf5", {global, 82, 450, 175}},
      {"CubeH8.hdf5", {global, 1, 162, 3}},
      {"LMGC_GlobalFrictionContactProblem00046.hdf5", {global, 9, 162, 27}},
  };
  for (const auto& [name, facts] : expected) {
    CAPTURE(name);
    ContactProblem p;
    if (!reference::read(name, p)) return;
    CHECK(p.kind == facts.kind);
    CHECK(p.dimension == 3);
    CHECK(p.contacts() == facts.contacts);
    CHECK(p.unknowns() == facts.unknowns);
    CHECK(fclib::rank_of_W(p) == facts.rank);
    CHECK(!p.title.empty());
  }
}

TEST_CASE("the condensed operators of a global problem: u = Wr + q is Hᵀv + w with M v = Hr + f") {
  if (!reference::present()) return;
  for (const std::string name : {"Box_Stacks-i0122-82-5.hdf5", "CubeH8.hdf5", "Spheres-i099-356-679.hdf5",
                                 "spheres-in-a-box-98-i10000-256-10.hdf5", "dat/GFC3D_TwoRods1.dat"}) {
    CAPTURE(name);
    ContactProblem p;
    if (!reference::read(name, p)) return;
    CHECK(p.symmetrised == (name == "CubeH8.hdf5"));
    const algebra::SparseMatrix transposed = p.M.transpose();
    const algebra::SparseMatrix M = p.symmetrised ? algebra::SparseMatrix(0.5 * (p.M + transposed)) : p.M;
    // Any v will do where r = 0 …
    const algebra::Vector v = algebra::Vector::LinSpaced(p.unknowns(), -1, 2);
    ContactProblem turned = p;
    turned.f = M * v;
    Monitor quiet;
    fclib::condense(turned, quiet);
    const algebra::Vector expected = p.H.transpose() * v + p.w;
    CHECK((turned.q - expected).norm() < 1e-9 * expected.norm());
    // … and W r is what q gains where f gains H r.
    const algebra::Vector r = algebra::Vector::LinSpaced(p.rows(), 1, -3);
    turned.f = p.f + p.H * r;
    fclib::condense(turned, quiet);
    CHECK((turned.q - p.q - p.W * r).norm() < 1e-10 * (turned.q.norm() + p.q.norm()));
  }
}

TEST_CASE("a stored matrix that is unsymmetric is named so") {
  if (!reference::present()) return;
  ContactProblem p;
  if (!reference::read("Capsules-i125-1213.hdf5", p)) return;
  CHECK(fclib::unsymmetry(p) == doctest::Approx(1.3e-3).epsilon(0.05));
  CHECK(!p.symmetrised);
  REQUIRE(reference::read("LMGC_GlobalFrictionContactProblem00046.hdf5", p));
  CHECK(fclib::unsymmetry(p) == doctest::Approx(1.5e-7).epsilon(0.05));
  CHECK(p.symmetrised);
}

TEST_CASE("rolling friction is refused") {
  if (!reference::present()) return;
  ContactProblem p;
  CHECK_THROWS_WITH_AS((void)reference::read("Chute-ndof-768-nc-4-3.hdf5", p), doctest::Contains("rolling friction"), InputError);
}

TEST_CASE("every text file but the one that holds no problem is read") {
  if (!reference::present()) return;
  int read = 0;
  for (const std::string& name : reference::files("dat/")) {
    CAPTURE(name);
    ContactProblem p;
    if (name == "dat/ACinputs.dat") {
      CHECK_THROWS_WITH_AS((void)reference::read(name, p), doctest::Contains("ACinputs.dat:1: the dimension"), InputError);
      continue;
    }
    REQUIRE(reference::read(name, p));
    ++read;
    const std::string stem = name.substr(4);
    CHECK((p.kind == global) == ((begins(stem, "GFC3D") && stem != "GFC3D_TwoRods1-condensed.dat") || begins(stem, "gfc2d")));
    CHECK((p.dimension == 2) == (begins(stem, "FC2D") || begins(stem, "fc2d") || begins(stem, "gfc2d") || begins(stem, "FrictionContactProblem")));
  }
  CHECK(read == 44);
}

TEST_CASE("one problem in two storages") {
  if (!reference::present()) return;
  ContactProblem dense, blocks;
  for (const auto& [one, other] : {std::pair{"dat/FC3D_Example1.dat", "dat/FC3D_Example1_SBM.dat"},
                                   std::pair{"dat/GFC3D_Example0.dat", "dat/GFC3D_Example0_SBM.dat"}}) {
    REQUIRE(reference::read(one, dense));
    REQUIRE(reference::read(other, blocks));
    CHECK(dense.W == blocks.W);
    CHECK(dense.q == blocks.q);
    CHECK(dense.mu == blocks.mu);
  }
  // Both rods in full and condensed by the code that printed them (blocks to six decimals, six digits).
  REQUIRE(reference::read("dat/GFC3D_TwoRods1.dat", dense));
  REQUIRE(reference::read("dat/GFC3D_TwoRods1-condensed.dat", blocks));
  CHECK((dense.W - blocks.W).cwiseAbs().maxCoeff() < 2e-6);
  CHECK((dense.q - blocks.q).norm() < 1e-5 * blocks.q.norm());
}

TEST_CASE("a text file: dense matrices run down their columns") {
  REQUIRE(refusal(kOne) == "");
  Monitor quiet;
  { std::ofstream("made.dat") << "2 1 0 2 2 2 2  1 2 3 4  5 6  0.25"; }
  const ContactProblem p = fclib::read("made.dat", quiet);
  CHECK(p.W == (algebra::DenseMatrix(2, 2) << 1, 3, 2, 4).finished());
  CHECK(p.q == (algebra::Vector(2) << 5, 6).finished());
  CHECK(p.mu[0] == 0.25);
  CHECK(p.name == "made.dat");
}

TEST_CASE("text files that are wrong: file, line and what is expected") {
  CHECK(refusal("") == "cannot read 'made.dat': it is empty");
  CHECK(begins(refusal("5 1"), "made.dat:1: the dimension of a contact problem is 5; from 2 to 3 is expected"));
  CHECK(begins(refusal("hello"), "made.dat:1: 'hello' stands where the dimension"));
  CHECK(refusal("3\n1\n7\n") == "made.dat:3: the storage of a matrix (0 dense, 1 blocks, 2 sparse) is 7; from 0 to 2 is expected");
  CHECK(begins(refusal("3\n2\n0\n3\n3\n3 3\n1 0 0 0 1 0 0 0 1\n1 2 3\n0.5"), "made.dat:7: the matrix has 3 rows: a local problem of 2 contacts has 6"));
  CHECK(begins(refusal("3\n1\n0\n3\n2\n3 2\n1 0 0 0 1 0"), "made.dat:7: the first matrix is 3 x 2, not square"));
  std::string one = kOne;
  CHECK(begins(refusal(one + "1 2 3"), "made.dat:11: 4 words are left over"));
  CHECK(begins(refusal(one.replace(one.find("0.5"), 3, "-.5")), "'made.dat': the friction coefficient of contact 1 is -0.5"));
  one = kOne;
  CHECK(begins(refusal(one.replace(one.find("-1 2"), 2, "nan")), "'made.dat': q holds a number that is not finite"));
  CHECK(begins(refusal("3 1000000 0 3000000 3000000 3000000 3000000 1"), "made.dat:1: the file is too short for 1e+06 contacts"));
  // Blocks whose indices do not fit.
  const std::string blocks = "2 1 1 2 2 1 1 1  2  2  2 1  0 1  0  0  1 0 0 1  5 6  0.5";
  CHECK(refusal(blocks) == "");
  std::string bad = blocks;
  CHECK(begins(refusal(bad.replace(bad.find("2 1  0 1  0"), 11, "2 1  0 1  3")), "made.dat:1: an entry of the column index is 3"));
  bad = blocks;
  CHECK(begins(refusal(bad.replace(bad.find("2 1  0 1"), 8, "2 1  0 0")), "made.dat:1: the row index ends at 0"));
  // A sparse matrix.
  const std::string sparse = "2\n1\n2\n2\n2\n2\nCSparse\n2-by-2, nzmax: 2 nnz: 2, 1-norm: 3\n    col 0 : locations 0 to 0\n      1 : 3\n"
                             "    col 1 : locations 1 to 1\n      0 : 2\n 5 6\n 0.5\n";
  CHECK(refusal(sparse) == "");
  bad = sparse;
  CHECK(begins(refusal(bad.replace(bad.find("1 : 3"), 1, "2")), "made.dat:10: the row of an entry is 2; from 0 to 1"));
  CHECK(begins(refusal("2\n1\n2\n2\n2\n2\nnothing\n"), "made.dat:7: 'CSparse' is expected"));
}

TEST_CASE("text files of a few bytes do not ask for memory, nor for hours") {
  // Counts in millions, none of which the file could hold.
  CHECK(begins(refusal("3 3333333 2 0 0 2 0 0"), "made.dat:1: the file is too short for 3.33333e+06 contacts"));
  CHECK(begins(refusal("3 0 2 10000000 10000000 10000000 10000000 CSparse"), "made.dat:1: the file is too short for 1e+07 rows"));
  CHECK(begins(refusal("3 0 1 0 10000000 0 0 10000000"), "made.dat:1: the file is too short for 1e+07 rows"));
  // Empty lines between the last columns of a sparse matrix, each of which was once looked at from every other.
  const std::string sparse = "2 1 2 2 2 2 CSparse\n2-by-2, nzmax: 1 nnz: 1, 1-norm: 3\n col 0 : locations 0 to 0\n 1 : 3\n";
  CHECK(refusal(sparse + std::string(3'000'000, '\n') + "col 1 : locations 1 to 0\n 5 6 0.5") == "");
  // A long word, and one that is no text, in a message.
  CHECK(refusal(std::string(100'000, 'x')).size() < 150);
  CHECK(begins(refusal("\x1b[2J"), "made.dat:1: '?[2J' stands where"));
}

TEST_CASE("a truncated text file is refused wherever it ends") {
  if (!reference::present()) return;
  for (const std::string name : {"dat/GFC3D_Example0_SBM.dat", "dat/gfc2d_granularflowonwall_00069_00350.dat", "dat/Rover1039.dat"}) {
    const std::string whole = test::bytes_of(reference::folder() + name);
    REQUIRE(!whole.empty());
    // At the end of a line short of the last two: a flag, and the friction coefficients.
    for (int tenth = 0; tenth < 10; ++tenth) {
      const auto end = whole.find('\n', whole.size() * tenth / 10 * 9 / 10);
      CAPTURE(name);
      CAPTURE(tenth);
      CHECK(refusal(whole.substr(0, end + 1)) != "");
    }
  }
}

TEST_CASE("HDF5 files that lead to other files are refused: a script from a stranger could read any file through them") {
  Monitor quiet;
  const std::string here = DOTYK_TEST_DIR "/files/";
  try {
    const ContactProblem p = fclib::read(DOTYK_TEST_DIR "/../fuzz/files/one.hdf5", quiet);  // sound, and the same but for its q
    CHECK(p.title == "one contact");
    CHECK(p.W(0, 1) == 1);
    CHECK(p.q[2] == 3);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    MESSAGE("skipped: " << error.what());
    return;
  }
  CHECK_THROWS_WITH_AS(fclib::read(here + "elsewhere.hdf5", quiet), doctest::Contains("fclib_local/vectors/q lies in another file, which is not read"), InputError);
  CHECK_THROWS_WITH_AS(fclib::read(here + "linked.hdf5", quiet), doctest::Contains("fclib_local/vectors/q is a link to another place, which is not followed"), InputError);
}

TEST_CASE("truncated and damaged HDF5 files") {
  if (!reference::present()) return;
  ContactProblem p;
  if (!reference::read("CubeH8.hdf5", p)) return;
  const std::string whole = test::bytes_of(reference::folder() + "CubeH8.hdf5");
  for (const double part : {0.001, 0.2, 0.5, 0.9, 0.999}) {
    CAPTURE(part);
    const std::string message = refusal(whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))), "made.hdf5");
    CHECK(message == "'made.hdf5': it is no whole HDF5 file: damaged or cut short");
  }
  // Another group name of the same length.
  std::string other = whole;
  for (auto at = other.find("fclib_global"); at != std::string::npos; at = other.find("fclib_global", at)) other.replace(at, 12, "fclib_glabol");
  CHECK(refusal(other, "made.hdf5") == "'made.hdf5': there is no group fclib_local or fclib_global in it");
  Monitor quiet;
  CHECK_THROWS_WITH_AS(fclib::read("no such file", quiet), "cannot read 'no such file': No such file or directory", InputError);
  CHECK_THROWS_WITH_AS(fclib::read(".", quiet), "cannot read '.': it is a folder", InputError);
}

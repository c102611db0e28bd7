#include <doctest/doctest.h>

#include <sstream>

#include "base/error.hpp"
#include "program/program_file.hpp"
#include "programs.hpp"

using namespace dotyk;
using test::Vector;

namespace {

program::QuadraticProgram read_text(const std::string& content) {
  std::istringstream in(content);
  return program::read_qps(in, "a.qps");
}

const std::string kHead =
    "NAME          TEST\nROWS\n N  obj\n G  r1\n L  r2\n E  r3\nCOLUMNS\n"
    "    c1  obj  1.5  r1  2.0\n    c1  r2  -1.0  r3  1\n    c2  obj  -2.0  r1  1.0\n    c2  r2  2.0\n";

}  // namespace

TEST_CASE("QPTEST of Maros and Meszaros: f = 8.3718750") {
  const auto p = read_text(
      "NAME          QPTEST\nROWS\n N  obj\n G  r1\n L  r2\nCOLUMNS\n    c1        obj       1.5       r1        2.0\n"
      "    c1        r2        -1.0\n    c2        obj       -2.0      r1        1.0\n    c2        r2        2.0\n"
      "RHS\n    rhs1      obj       -4.0      r1        2.0\n    rhs1      r2        6.0\nRANGES\nBOUNDS\n"
      " UP bnd1      c1        20.0\nQUADOBJ\n    c1        c1        8.0\n    c1        c2        2.0\n"
      "    c2        c2        10.0\nENDATA\n");
  Monitor quiet;
  const auto r = program::solve(p, test::one(), quiet);
  CHECK(p.name == "QPTEST");
  CHECK(r.status == program::Status::solved);
  CHECK(r.objective == doctest::Approx(8.3718750).epsilon(1e-9));
  CHECK(r.x[0] == doctest::Approx(0.7625));
  CHECK(r.x[1] == doctest::Approx(0.475));
}

TEST_CASE("ranges: the sign counts for equalities only") {
  const auto p = read_text(kHead + "RHS\n    r1 2 r2 6\n    r3 1\nRANGES\n    rng r1 3 r2 -4\n    rng r3 -2\nENDATA\n");
  CHECK(p.low.head(3) == Vector{{2, 2, -1}});
  CHECK(p.high.head(3) == Vector{{5, 6, 1}});
}

TEST_CASE("bounds of every kind; an upper bound below zero frees the lower one") {
  const auto bounds = [](const std::string& lines) {
    const auto p = read_text(kHead + "BOUNDS\n" + lines + "ENDATA\n");
    std::ostringstream out;
    for (int r = 3; r < p.rows(); ++r)
      out << 'c' << program::SparseRows::InnerIterator(p.A, r).col() + 1 << ' ' << p.low[r] << ' ' << p.high[r] << "; ";
    return out.str();
  };
  CHECK(bounds("") == "c1 0 inf; c2 0 inf; ");
  CHECK(bounds(" UP b c1 4\n LO b c2 -3\n") == "c1 0 4; c2 -3 inf; ");
  CHECK(bounds(" UP b c1 -4\n") == "c1 -inf -4; c2 0 inf; ");
  CHECK(bounds(" LO b c1 -9\n UP b c1 -4\n") == "c1 -9 -4; c2 0 inf; ");
  CHECK(bounds(" FX b c1 7\n FR b c2\n") == "c1 7 7; ");
  CHECK(bounds(" MI b c1\n UP b c1 5\n PL b c2\n") == "c1 -inf 5; c2 0 inf; ");
  CHECK(bounds(" FR c1\n UP c2 3\n") == "c2 0 3; ");
  CHECK(bounds(" UP b c1 4\n UP other c1 9\n") == "c1 0 4; c2 0 inf; ");
  CHECK(bounds(" UP b c1 1e30\n") == "c1 0 inf; c2 0 inf; ");
}

TEST_CASE("QMATRIX has both triangles, QUADOBJ one; OBJSENSE MAX negates") {
  const auto one = read_text(kHead + "QUADOBJ\n c1 c1 8\n c1 c2 2\n c2 c2 10\nENDATA\n");
  const auto both = read_text(kHead + "QMATRIX\n c1 c1 8\n c1 c2 2\n c2 c1 2\n c2 c2 10\nENDATA\n");
  CHECK(test::full(one.P) == test::full(both.P));
  const auto most = read_text("NAME x\nOBJSENSE\n    MAX\nROWS\n N o\nCOLUMNS\n a o 3\nRHS\n o -5\nENDATA\n");
  CHECK(most.q[0] == -3);
  CHECK(most.r == -5);
}

TEST_CASE("errors name file and line") {
  const auto fails = [](const std::string& content, const std::string& message) {
    CHECK_THROWS_WITH_AS(read_text(content), message.c_str(), InputError);
  };
  fails("ROWS\n N obj\n X r1\nENDATA\n", "a.qps:3: row type 'X'; it must be N, E, L or G");
  fails("ROWS\n N obj\n G obj\nENDATA\n", "a.qps:3: row 'obj' is named twice");
  fails("ROWS\n N obj\nCOLUMNS\n c1 objj 1\nENDATA\n", "a.qps:4: unknown row 'objj'");
  fails("ROWS\n N obj\nCOLUMNS\n c1 obj 1,5\nENDATA\n", "a.qps:4: '1,5' is not a number");
  fails(kHead + "QUADOBJ\n c1 c9 1\nENDATA\n", "a.qps:13: unknown column 'c9'");
  fails(kHead + "QMATRIX\n c1 c2 1\nENDATA\n", "a.qps:14: QMATRIX is not symmetric: give both triangles, or QUADOBJ and one");
  fails(kHead + "BOUNDS\n BV b c1\nENDATA\n", "a.qps:13: bound type BV: integer and semicontinuous variables are not supported");
  fails(kHead + "STUFF\nENDATA\n", "a.qps:12: unknown section 'STUFF'");
  fails(kHead, "a.qps:11: the file ends without ENDATA");
  fails("ROWS\n G r\nCOLUMNS\n c r 1\nENDATA\n", "a.qps:5: no row of type N: there is no objective");
  CHECK_THROWS_WITH_AS(program::read_qps(std::string("/nowhere/a.qps")), "cannot read '/nowhere/a.qps': No such file or directory", InputError);
}

TEST_CASE("lines and words without end are refused in a short message") {
  const std::string long_word(1'000'000, 'x');
  const auto message = [](const std::string& content) -> std::string {
    try {
      read_text(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  std::string words = " ";
  for (int k = 0; k < 1000; ++k) words += " r1 1";
  CHECK(message(kHead + "RHS\n" + words + "\nENDATA\n") == "a.qps:13: a line of more than 20 words");
  CHECK(message("NAME" + words + "\n" + kHead.substr(kHead.find("ROWS")) + "ENDATA\n") == "");  // a title of many words
  for (const std::string& bad : {long_word + "\n", "ROWS\n N " + long_word + "\n N " + long_word + "\n", kHead + "RHS\n b " + long_word + " 1\n",
                                 kHead + "RHS\n b r1 " + long_word + "\n", kHead + "BOUNDS\n UP b " + long_word + " 1\n", kHead + "OBJSENSE\n " + long_word + "\n"}) {
    const std::string told = message(bad);
    CHECK(!told.empty());
    CHECK(told.size() < 200);
  }
  CHECK(message(kHead + "RHS\n b r1 \x1b[2J\n") == "a.qps:13: '?[2J' is not a number");
  CHECK(message(kHead + "RHS\n b obj 1e30\nENDATA\n") == "a.qps:13: the constant of the objective is not finite");
}

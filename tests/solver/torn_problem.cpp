#include "solver/feti/torn_problem.hpp"

#include <doctest/doctest.h>

#include "../support/dual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("rows of a torn problem, in the measure of 1/k: norm one; gluing ones orthonormal and orthogonal to the problem's") {
  for (const bool support_rows : {true, false}) {
    const auto p = test::cut_box(support_rows, 2);
    const auto torn = solver::tear(p);
    CHECK((torn.support_rows > 0) == support_rows);
    REQUIRE(torn.rows() == torn.problem_rows() + torn.gluing_rows + torn.support_rows);
    const DenseMatrix B = torn.B, gram = B * torn.touched_weight.asDiagonal() * B.transpose();
    CHECK((gram - DenseMatrix::Identity(B.rows(), B.rows())).cwiseAbs().maxCoeff() < 1e-14);
    // Each unknown of m copies has m − 1 gluing rows.
    CHECK(torn.copies() - torn.support_rows - torn.gluing_rows == p.unknowns());
    CHECK(torn.Bt.rows() == torn.B.cols());
    CHECK(test::relative(DenseMatrix(torn.Bt), B.transpose()) == 0);
  }
}

TEST_CASE("copies of one displacement satisfy the gluing and support rows and jump as it does; their energies add up") {
  test::Random random(501);
  for (const bool support_rows : {true, false}) {
    const auto p = test::cut_box(support_rows, 2);
    const auto torn = solver::tear(p);
    const Vector u = random.vector(p.unknowns());
    Vector v(torn.copies()), t(torn.B.cols());
    for (int k = 0; k < torn.copies(); ++k) v[k] = torn.unknown[k] < 0 ? torn.value[k] : u[torn.unknown[k]];
    double energy = 0;
    for (const auto& piece : torn.pieces) {
      const Vector own = v.segment(piece.first, piece.size());
      energy += 0.5 * own.dot(piece.K->selfadjointView<Eigen::Lower>() * own) - piece.f->dot(own);
      for (std::size_t i = 0; i < piece.touched.size(); ++i) t[piece.first_touched + i] = own[piece.touched[i]];
    }
    const Vector x = torn.B * t - torn.c;
    CHECK(test::relative(x.head(p.rows()), torn.scale.cwiseProduct(p.B * u - p.c)) < 1e-14);
    CHECK(x.tail(torn.rows() - p.rows()).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(test::relative(solver::average(torn, v), u) < 1e-14);
    CHECK(test::disagreement(torn, v) < 1e-14);
    const auto& b = p.blocks[0];
    const double whole = 0.5 * u.dot(b.K.lower().selfadjointView<Eigen::Lower>() * u) - b.f.dot(u);
    const double missing = support_rows ? b.offset : 0;  // pieces whose supports stay in K leave their offset out as well
    CHECK(energy == doctest::Approx(whole + missing).epsilon(1e-12));
  }
}

TEST_CASE("one gap between the copies shows in their disagreement") {
  const auto p = test::cut_box(true, 2);
  const auto torn = solver::tear(p);
  Vector v = Vector::Zero(torn.copies());
  for (int k = 0; k < torn.copies(); ++k) v[k] = torn.value[k];
  int shared = 0;  // the first copy of an unknown that has further ones
  std::vector<int> count(p.unknowns(), 0);
  for (int j : torn.unknown)
    if (j >= 0) ++count[j];
  while (torn.unknown[shared] < 0 || count[torn.unknown[shared]] < 2) ++shared;
  v[shared] = 1;
  CHECK(test::disagreement(torn, v) == doctest::Approx(1 - 1.0 / count[torn.unknown[shared]]));
}

TEST_CASE("rows of pieces of unlike stiffness: k is K's diagonal, soft copies carry little of a row and are averaged out") {
  test::Random random(503);
  for (const double contrast : {1e-6, 1e12}) {
    auto p = test::cut_box(true, 2);
    auto other = *p.subdomains[1].stiffness;
    other.K = algebra::SparseMatrix(contrast * other.K.lower());
    p.subdomains[1].stiffness = std::make_shared<const problem::Stiffness>(other);
    const auto torn = solver::tear(p);
    const DenseMatrix B = torn.B, gram = B * torn.touched_weight.asDiagonal() * B.transpose();
    CHECK((gram - DenseMatrix::Identity(B.rows(), B.rows())).cwiseAbs().maxCoeff() < 1e-14);
    double greatest = 0;
    for (const auto& piece : torn.pieces) greatest = std::max(greatest, Vector(piece.K->diagonal()).maxCoeff());
    for (const auto& piece : torn.pieces)
      CHECK(test::relative(torn.stiffness.segment(piece.first, piece.size()), Vector(piece.K->diagonal()) / greatest) < 1e-15);
    // Copies of one displacement are its own mean and do not jump; a soft one moved hardly moves the mean.
    const Vector u = random.vector(p.unknowns());
    Vector v(torn.copies()), t(torn.B.cols());
    for (int k = 0; k < torn.copies(); ++k) v[k] = torn.unknown[k] < 0 ? torn.value[k] : u[torn.unknown[k]];
    for (const auto& piece : torn.pieces)
      for (std::size_t i = 0; i < piece.touched.size(); ++i) t[piece.first_touched + i] = v[piece.first + piece.touched[i]];
    const Vector x = torn.B * t - torn.c;
    CHECK(x.segment(p.rows(), torn.gluing_rows).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(test::relative(solver::average(torn, v), u) < 1e-14);
    for (int k = 0; k < torn.copies(); ++k) v[k] += torn.stiffness[k] < 1e-3 * torn.stiffness.maxCoeff();
    int shared = 0;
    const Vector mean = solver::average(torn, v);
    for (const auto& piece : torn.pieces)
      for (int i = 0; i < piece.size(); ++i) {
        const int k = piece.first + i, j = torn.unknown[k];
        if (j < 0 || torn.stiffness[k] < 1e-3 * torn.stiffness.maxCoeff()) continue;
        shared += v[k] == u[j];
        CHECK(std::abs(mean[j] - u[j]) < 1e-4);
      }
    CHECK(shared > 0);
  }
}

TEST_CASE("an unknown without stiffness of its own counts for the stiffest of its piece") {
  problem::Problem p;
  for (const double entry : {0.0, 4.0}) {
    DenseMatrix K = DenseMatrix::Zero(2, 2);
    K(0, 0) = entry;
    problem::Block block;
    block.name = "b";
    block.K = test::lower(K);
    block.f = Vector::Zero(2);
    block.node = {0, 1};
    block.kernel = DenseMatrix::Identity(2, 2).rightCols(entry > 0 ? 1 : 2);
    problem::add(p, block);
  }
  p.B.resize(0, 4);
  p.c.resize(0);
  CHECK(solver::tear(p).stiffness == Vector{{1, 1, 1, 1}});
}

TEST_CASE("without subdomains each block is a piece; the rows of a friction point share their factor") {
  test::Random random(502);
  problem::Problem p;
  for (const char* name : {"a", "b"})
    problem::add(p, test::block(name, test::spring_grid(random, 3, 2, 3, 0.2), random.vector(18), 3, false));
  DenseMatrix B = DenseMatrix::Zero(4, 36);
  B(0, 0) = 3, B(0, 20) = -4;                       // normal row
  B(1, 1) = 6, B(1, 21) = 8, B(2, 2) = 1, B(2, 22) = 1;  // tangential rows of it
  p.B = test::rows(B);                              // row 3 is empty
  p.c = Vector{{1, 2, 3, 4}};
  p.groups = {test::group(problem::unilateral(), 0, 1), test::group(problem::unilateral(), 3, 1)};
  p.friction = {{"friction", problem::tresca({1.0}), 1, 2, {0}}};
  const auto torn = solver::tear(p);
  CHECK(torn.pieces.size() == 2);
  CHECK(torn.pieces[1].name == "'b'");
  CHECK(torn.pieces[1].K == &p.blocks[1].K.lower());
  CHECK(torn.gluing_rows + torn.support_rows == 0);
  const auto softness = [&](int k) { return 1 / torn.stiffness[k]; };
  const double normal = 1 / std::sqrt(9 * softness(0) + 16 * softness(20)),
               tangential = 1 / std::sqrt(std::max(36 * softness(1) + 64 * softness(21), softness(2) + softness(22)));
  CHECK(test::relative(torn.scale, Vector{{normal, tangential, tangential, 1}}) < 1e-15);
  CHECK(test::relative(torn.c, Vector{{normal, 2 * tangential, 3 * tangential, 4}}) < 1e-15);
  CHECK(torn.pieces[0].touched == std::vector<int>{0, 1, 2});
  CHECK(torn.pieces[1].touched == std::vector<int>{2, 3, 4});
}

TEST_CASE("a spring is as a piece of one unknown between body and ground: rows of norm one with it, its compliance in F") {
  for (const double k : {1e-6, 1.0, 1e6}) {
    auto p = test::cut_box(true, 2);
    p.groups[0].law = problem::elastic(std::vector<double>(p.groups[0].count, k));
    const auto plain = test::dual_of(p);
    auto& piece = p.subdomains[1];
    piece.S = DenseMatrix(DenseMatrix::Ones(1, piece.size()) / piece.size()).sparseView();
    piece.spring = Vector::Constant(1, 3 * k);
    const auto torn = solver::tear(p);
    REQUIRE(torn.rows() == torn.problem_rows() + torn.gluing_rows + torn.support_rows + 1);
    const DenseMatrix B = torn.B;
    const Vector gram = (B * torn.touched_weight.asDiagonal() * B.transpose()).diagonal();
    CHECK((gram + torn.stiffest * torn.compliance - Vector::Ones(torn.rows())).cwiseAbs().maxCoeff() < 1e-13);
    const auto& group = p.groups[0];
    for (int r = group.first; r < group.first + group.count; ++r)
      CHECK(torn.compliance[r] == doctest::Approx(torn.scale[r] * torn.scale[r] / k));
    CHECK(torn.compliance.segment(p.rows(), torn.gluing_rows + torn.support_rows).isZero(0));
    // Copies at v stretch the spring by its row, unscaled by what its compliance says of its scale.
    test::Random random(502);
    const Vector own = random.vector(piece.size());
    Vector touched = Vector::Zero(B.cols());
    const auto& cut = torn.pieces[1];
    for (std::size_t i = 0; i < cut.touched.size(); ++i) touched[cut.first_touched + i] = own[cut.touched[i]];
    const int last = torn.rows() - 1;
    CHECK((B * touched)[last] == doctest::Approx(std::sqrt(torn.compliance[last] * 3 * k) * own.mean()));
    // F without the spring is a part of F with it. The generalised inverse is the same: K is.
    const auto dual = test::dual_of(p);
    const Vector lambda = random.vector(last);
    Vector longer = Vector::Zero(torn.rows());
    longer.head(last) = lambda;
    CHECK(test::relative(dual.apply(longer).head(last), plain.apply(lambda)) < 1e-12);
    CHECK(dual.apply(Vector::Unit(torn.rows(), last))[last] > torn.compliance[last]);
  }
}

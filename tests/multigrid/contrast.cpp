// Two bodies that touch, their jumps as unknowns: iterations do not grow with the contrast of their stiffness.
#include <doctest/doctest.h>

#include <map>

#include "built.hpp"
#include "elastic_cube.hpp"
#include "multigrid/multigrid.hpp"

using namespace dotyk;
using algebra::SparseMatrix;
using Eigen::Triplet;

namespace {

/// A cube of 6³ cells, `factor` times as stiff as the cube of 12³ cells that lies on it; the bottom of the one and the top of the other are fixed.
struct Pair {
  SparseMatrix K, lower, S;  ///< of displacements; of unknowns, S of them; lower triangles but for S
  std::vector<int> node, jumps;
  algebra::DenseMatrix motions;
};

Pair stiff_below_soft(double factor) {
  constexpr int kCoarse = 6;
  const test::ElasticCube below = test::cube_on_its_bottom(kCoarse);
  const test::ElasticCube above = test::elastic_cube(2 * kCoarse, [](const std::array<double, 3>& p, int) { return p[2] == 1; });
  const int first = static_cast<int>(below.node.size()), size = first + static_cast<int>(above.node.size());
  Pair pair;
  std::vector<Triplet<double>> entries, jumps;
  for (int j = 0; j < first; ++j)
    for (SparseMatrix::InnerIterator it(below.lower, j); it; ++it) entries.emplace_back(it.row(), j, factor * it.value());
  for (int j = 0; j < size - first; ++j)
    for (SparseMatrix::InnerIterator it(above.lower, j); it; ++it) entries.emplace_back(first + it.row(), first + j, it.value());
  pair.K.resize(size, size);
  pair.K.setFromTriplets(entries.begin(), entries.end());
  pair.node = below.node;
  for (const int n : above.node) pair.node.push_back(below.node.back() + 1 + n);
  pair.motions = algebra::DenseMatrix(size, 6);
  pair.motions << below.motions, above.motions;
  for (int i = first; i < size; ++i)  // it lies one higher: rotations about x and y move it along y and x
    for (const int axis : {0, 1}) pair.motions(i, 3 + axis) += (axis == 0 ? -1 : 1) * pair.motions(i, 1 - axis);
  // A jump is the displacement below less the mean above, weighted by the coarse hat.
  std::vector<Triplet<double>> of, inverse;
  for (int i = 0; i < size; ++i) of.emplace_back(i, i, 1), inverse.emplace_back(i, i, 1);
  for (int i = 0; i < first; ++i) {
    const auto& p = below.point[i];
    if (below.component[i] != 2 || p[2] < 1 - 1e-9) continue;
    pair.jumps.push_back(i);
    std::map<int, double> mean;
    double sum = 0;
    for (int j = 0; j < size - first; ++j) {
      const auto& q = above.point[j];
      const double hat = std::max(0.0, 1 - kCoarse * std::abs(p[0] - q[0])) * std::max(0.0, 1 - kCoarse * std::abs(p[1] - q[1]));
      if (above.component[j] == 2 && q[2] < 1e-9 && hat > 1e-9) mean[first + j] = hat, sum += hat;
    }
    for (const auto& [j, hat] : mean) of.emplace_back(i, j, -hat / sum), inverse.emplace_back(i, j, hat / sum);
  }
  SparseMatrix T(size, size);
  pair.S.resize(size, size);
  pair.S.setFromTriplets(of.begin(), of.end());
  T.setFromTriplets(inverse.begin(), inverse.end());
  const SparseMatrix full = pair.K.selfadjointView<Eigen::Lower>(), half = full * T;
  pair.lower = (T.transpose() * half).triangularView<Eigen::Lower>();
  return pair;
}

}  // namespace

TEST_CASE("iterations do not grow with the contrast of two bodies that touch") {
  if (test::not_built()) return;
  Monitor monitor;
  int alike = 0;
  for (const double factor : {1.0, 30.0, 1000.0}) {
    const Pair pair = stiff_below_soft(factor);
    const auto solver = multigrid::make_solver({pair.lower, pair.node, [&] { return pair.motions; }, &pair.K, &pair.S}, monitor);
    for (const int of_three : {3, 2, 1}) {  // of three jumps are closed
      CAPTURE(factor);
      CAPTURE(of_three);
      std::vector<char> held(pair.node.size(), 0);
      for (std::size_t k = 0; k < pair.jumps.size(); ++k) held[pair.jumps[k]] = static_cast<int>(k % 3) < of_three;
      const SparseMatrix K = test::holding(pair.lower, held);
      algebra::Vector b = algebra::Vector::LinSpaced(K.rows(), -1, 2);
      for (Eigen::Index i = 0; i < b.size(); ++i)
        if (held[i]) b[i] = 0;
      REQUIRE(solver->set(test::entries(K), held));
      const int before = solver->iterations();
      const algebra::Vector x = solver->solve(b, 1e-8);
      CHECK((b - K.selfadjointView<Eigen::Lower>() * x).norm() <= 1.01e-8 * b.norm());
      const int count = solver->iterations() - before;
      if (factor == 1) alike = std::max(alike, count);
      else CHECK(count <= 1.5 * alike);
    }
  }
}

#pragma once

// Quadratic programs with equality constraints over separable sets whose solution is chosen first.
#include <optional>

#include "known_minimum.hpp"
#include "solver/bounded/smalbe.hpp"

namespace dotyk::test {

/// Ends Smalbe where both norms are below.
inline solver::SmalbeCaller until(double small) {
  return {[small](double g, double e, const Vector&) { return g <= small && e <= small; }, {}, {}};
}

/// minimise ½xᵀHx − bᵀx over Ω with Qx = 0 and its solution: H = PFP with spectrum [least, 1] on the kernel of Q =
/// GᵀG, G of k orthonormal rows; or H positive definite on the whole space.
struct KnownEquality {
  KnownEquality(unsigned seed, int n, int k, Shape shape, double least, bool complementary, double degenerate = 0)
      : random(seed), known(known_minimum(random, n, shape, degenerate)) {
    const DenseMatrix V = orthonormal(random, n, n), G = V.leftCols(k).transpose();
    Q = G.transpose() * G;
    H = random_matrix(random, n, least);
    if (complementary) {
      const DenseMatrix N = V.rightCols(n - k);
      H = N * random_matrix(random, n - k, least) * N.transpose();
    }
    // Moves Ω along so that the solution has Qx = 0.
    shift = -Q * known.x;
    x = known.x + shift;
    std::vector<solver::SeparableSet::Disc> discs = known.set.discs();
    for (auto& disc : discs) disc.centre += Eigen::Vector2d(shift[disc.first], shift[disc.second]);
    set.emplace(known.set.low() + shift, known.set.high() + shift, discs);
    // b in the kernel of Q where H is, as P d is: the multiplier ν takes the rest.
    const Vector rest = H * x - known.g;
    b = complementary ? Vector(rest - Q * rest) : rest;
    if (!complementary) b += Q * random.vector(n);
  }
  solver::EqualityProgram program(bool complementary) const {
    return {[this](const Vector& v) -> Vector { return H * v; }, 1, [this](const Vector& v) -> Vector { return Q * v; },
            complementary, b, &*set};
  }

  Random random;
  KnownMinimum known;
  DenseMatrix H, Q;
  Vector shift, x, b;
  std::optional<solver::SeparableSet> set;
};

}  // namespace dotyk::test

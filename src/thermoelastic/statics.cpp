#include "thermoelastic/statics.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

namespace dotyk::thermoelastic {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// What a motion does to the unknowns that have laws: laws × motions.
DenseMatrix on_laws(const Part& part) {
  DenseMatrix N(part.held.size(), part.kernel.cols());
  for (std::size_t i = 0; i < part.held.size(); ++i)
    N.row(static_cast<int>(i)) = part.kernel.row(part.held[i].unknown - part.first);
  return N;
}

/// Motions have amounts of one size; a law nearer than this part of it to having no say has none.
constexpr double kNoSay = 1e-9;

}  // namespace

bool determinate(const Part& part) {
  const DenseMatrix N = on_laws(part);
  if (N.rows() == 0) return true;
  if (N.rows() > N.cols()) return false;
  const Vector values = algebra::singular_values(N);
  return values[values.size() - 1] > kNoSay * values[0];
}

std::optional<Static> by_statics(const Part& part, const Forces& forces) {
  const Vector f = forces.f.segment(part.first, part.effect.unknowns());
  const DenseMatrix N = on_laws(part);
  const Vector e = part.kernel.transpose() * f;
  Static out{Vector::Zero(N.rows()), Vector::Zero(N.rows()), {}};
  if (N.rows() > 0) out.reactions = -algebra::least_squares(DenseMatrix(N.transpose()), e);
  const Vector scale = part.kernel.cwiseAbs().transpose() * f.cwiseAbs();
  const Vector left = e + N.transpose() * out.reactions;
  if ((left.array().abs() > kNoSay * scale.array()).any()) return std::nullopt;
  Vector all = f;
  for (std::size_t i = 0; i < part.held.size(); ++i) {
    const Held& held = part.held[i];
    const double r = out.reactions[static_cast<int>(i)];
    const auto v = problem::sole_displacement(held.law, held.turn * r * held.unit);
    if (!v) return std::nullopt;
    out.w[static_cast<int>(i)] = held.unit * (held.turn * *v + held.place(forces.supports));
    all[held.unknown - part.first] += r;
  }
  out.stress = part.effect.stress(all);
  return out;
}

Vector displacement(const Part& part, const OnCells& strain, const Vector& w) {
  Vector u = part.effect.displacement(strain);
  const DenseMatrix N = on_laws(part);
  if (N.rows() > 0) {
    Vector missing = w;
    for (std::size_t i = 0; i < part.held.size(); ++i) missing[static_cast<int>(i)] -= u[part.held[i].unknown - part.first];
    u += part.kernel * algebra::MinimumNorm(N).solve(missing);
  }
  remove_unnoticed(part, u);
  return u;
}

void remove_unnoticed(const Part& part, Eigen::Ref<Vector> u) {
  const DenseMatrix N = on_laws(part);
  DenseMatrix motions = part.kernel;
  if (N.rows() > 0) {
    const algebra::PivotedLu lu(N);
    if (lu.rank() == N.cols()) return;
    motions = part.kernel * lu.kernel();
  }
  u -= motions * algebra::least_squares(motions, Vector(u));
}

}  // namespace dotyk::thermoelastic

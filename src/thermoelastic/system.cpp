#include "thermoelastic/system.hpp"

#include <algorithm>
#include <stdexcept>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"

namespace dotyk::thermoelastic {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

/// What a motion does to the unknowns that have laws: laws × motions.
DenseMatrix on_laws(const Part& part) {
  DenseMatrix N(part.held.size(), part.kernel.cols());
  for (std::size_t i = 0; i < part.held.size(); ++i)
    N.row(static_cast<int>(i)) = part.kernel.row(part.held[i].unknown - part.first);
  return N;
}

/// Motions have amounts of one size; a law nearer than this part of it to having no say has none.
constexpr double kNoSay = 1e-9;

using Entries = std::vector<Eigen::Triplet<double>>;

/// Unknowns of a part at its ends and supports: the ends alone hold it.
void add_gamma(const Model& model, int p, std::vector<int>& gamma) {
  const Part& part = model.parts[p];
  const int last = part.first + part.effect.unknowns() - 1;
  std::vector<int> own{part.first, last};
  if (part.effect.kind() == Effect::Kind::bending) own.insert(own.end(), {part.first + 1, last - 1});
  for (const Held& held : part.held) own.push_back(held.unknown);
  std::sort(own.begin(), own.end());
  gamma.insert(gamma.end(), own.begin(), std::unique(own.begin(), own.end()));
}

/// Rᵀf on the motions of these parts.
Vector resultants(const Model& model, const std::vector<int>& parts, const Vector& f) {
  std::vector<double> out;
  for (const int p : parts) {
    const Part& part = model.parts[p];
    const Vector own = part.kernel.transpose() * f.segment(part.first, part.effect.unknowns());
    out.insert(out.end(), own.begin(), own.end());
  }
  return Eigen::Map<const Vector>(out.data(), static_cast<int>(out.size()));
}

SparseMatrix lower(int n, const Entries& entries) {
  SparseMatrix out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

void finish(const Model& model, Fields& fields, const std::vector<int>& parts) {
  for (const int p : parts) {
    const Part& part = model.parts[p];
    remove_unnoticed(part, fields.u.segment(part.first, part.effect.unknowns()));
  }
}

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

Condensation::Condensation(const SparseMatrix& lower, std::vector<int> gamma) : gamma_(std::move(gamma)) {
  std::vector<int> place(lower.rows(), 0);  // of an unknown among the inner ones; −1 − its place in Γ for those
  const int count = static_cast<int>(gamma_.size());
  for (int k = 0; k < count; ++k) place[gamma_[k]] = -1 - k;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) place[i] = static_cast<int>(inner_.size()), inner_.push_back(static_cast<int>(i));
  const int inner = static_cast<int>(inner_.size());
  std::vector<Eigen::Triplet<double>> entries;
  DenseMatrix across = DenseMatrix::Zero(inner, count);
  S_ = DenseMatrix::Zero(count, count);
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(lower, j); a; ++a) {
      const int p = place[a.row()], q = place[j];
      if (p >= 0 && q >= 0) entries.emplace_back(p, q, a.value());
      else if (p < 0 && q < 0) S_(-1 - p, -1 - q) = S_(-1 - q, -1 - p) = a.value();
      else if (q < 0) across(p, -1 - q) = a.value();
      else across(q, -1 - p) = a.value();
    }
  SparseMatrix interior(inner, inner);
  interior.setFromTriplets(entries.begin(), entries.end());
  factor_.emplace(interior);
  if (!factor_->factor(interior))
    throw std::runtime_error("its matrix cannot be factored; choose units in which its numbers are moderate");
  W_.resize(across.rows(), count);
  for (int k = 0; k < count; ++k) W_.col(k) = -factor_->solve(across.col(k));
  S_ += across.transpose() * W_;
  S_ = (0.5 * (S_ + S_.transpose())).eval();
}

Vector Condensation::condensed(const Vector& b) const { return b(gamma_) + W_.transpose() * b(inner_); }

Vector Condensation::recovered(const Vector& b, const Vector& on_gamma) const {
  Vector x(b.size());
  x(inner_) = factor_->solve(b(inner_)) + W_ * on_gamma;
  x(gamma_) = on_gamma;
  return x;
}

System::System(const Model& model, std::vector<char> decomposed, double tau)
    : model_(model), decomposed_(std::move(decomposed)), tau_(tau) {
  number();
  std::vector<int> all;
  for (const int unknown : gamma_) all.push_back(place_[unknown]);
  for (const HeldTemperature& held : model.held_heat) all.push_back(heat_ + held.unknown);
  condensation_.emplace(matrix(), all);
  const int own = static_cast<int>(gamma_.size());
  if (!coupled_.empty()) interface_.emplace(model, coupled_, gamma_, condensation_->schur().topLeftCorner(own, own));
}

void System::number() {
  place_.assign(model_.K.rows(), -1);
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    if (decomposed_[p]) continue;
    const Part& part = model_.parts[p];
    coupled_.push_back(static_cast<int>(p));
    for (int i = 0; i < part.effect.unknowns(); ++i) place_[part.first + i] = heat_++;
    add_gamma(model_, static_cast<int>(p), gamma_);
  }
}

SparseMatrix System::matrix() const {
  Entries entries;
  const auto put = [&](int i, int j, double value) {
    if (i >= j) entries.emplace_back(i, j, value);
  };
  const auto& [K, G] = std::tie(model_.K, model_.G);
  for (int j = 0; j < K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(K, j); a; ++a)
      if (place_[j] >= 0 && place_[a.row()] >= 0) put(place_[a.row()], place_[j], a.value());
  for (int j = 0; j < G.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(G, j); a; ++a)
      if (place_[a.row()] >= 0) put(heat_ + j, place_[a.row()], a.value());
  const SparseMatrix heat = model_.capacity + tau_ * model_.conduction;
  for (int j = 0; j < heat.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(heat, j); a; ++a) put(heat_ + a.row(), heat_ + j, -a.value());
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    if (!decomposed_[p]) continue;
    const Part& part = model_.parts[p];
    const Vector factor = part.effect.beta().cwiseAbs2().cwiseProduct(part.effect.modulus());
    for (int cell = 0; cell < part.effect.cells(); ++cell) {
      const auto P = model_.heat.projection(cell);
      const Eigen::Matrix4d added = factor[cell] * part.effect.h(cell) * P.transpose() * P;
      const int at = heat_ + part.first_heat + 2 * cell;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) put(at + i, at + j, -added(i, j));
    }
  }
  return lower(heat_ + static_cast<int>(heat.rows()), entries);
}

bool System::update_statics(const Forces& forces) {
  if (f_.size() == forces.f.size() && f_ == forces.f && driven_ == forces.supports) return true;
  f_.resize(0);
  statics_.resize(model_.parts.size());
  heating_ = Vector::Zero(model_.capacity.rows());
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    if (!decomposed_[p]) continue;
    const Part& part = model_.parts[p];
    auto found = by_statics(part, forces);
    if (!found) return false;
    heating_.segment(part.first_heat, model_.heat.unknowns()) = model_.heat.product(found->stress * (-part.effect.beta()).asDiagonal());
    statics_[p] = *std::move(found);
  }
  f_ = forces.f;
  driven_ = forces.supports;
  return true;
}

void System::add_decomposed(Fields& fields) const {
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    if (!decomposed_[p]) continue;
    const Part& part = model_.parts[p];
    const OnCells strain =
        statics_[p].stress * part.effect.modulus().cwiseInverse().asDiagonal() +
        model_.heat.projected(fields.theta.segment(part.first_heat, model_.heat.unknowns())) * part.effect.beta().asDiagonal();
    fields.u.segment(part.first, part.effect.unknowns()) = displacement(part, strain, statics_[p].w);
    fields.reactions[p] = statics_[p].reactions;
  }
}

std::optional<Fields> System::solve(const Forces& forces, const Vector& b, double t, bool displaced, const solver::Method& method,
                                    Work& work, Monitor& monitor) {
  if (!update_statics(forces)) return std::nullopt;
  const int heats = static_cast<int>(b.size()), own = static_cast<int>(gamma_.size());
  Vector right(heat_ + heats);
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (place_[i] >= 0) right[place_[i]] = forces.f[static_cast<int>(i)];
  right.tail(heats) = -(b + heating_);
  Fields out{Vector(model_.K.rows()), Vector(), std::vector<Vector>(model_.parts.size())};
  Vector on_gamma(own + forces.held_heat.size());
  on_gamma.tail(forces.held_heat.size()) = forces.held_heat;
  if (interface_) {
    const Vector g = condensation_->condensed(right).head(own) -
                     condensation_->schur().topRightCorner(own, forces.held_heat.size()) * forces.held_heat;
    on_gamma.head(own) = interface_->solve(g, resultants(model_, coupled_, forces.f), forces.supports, t, method, out.reactions, work, monitor);
  }
  const Vector x = condensation_->recovered(right, on_gamma);
  out.theta = x.tail(heats);
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (place_[i] >= 0) out.u[static_cast<int>(i)] = x[place_[i]];
  if (displaced) add_decomposed(out);
  finish(model_, out, coupled_);
  return out;
}

Fields at_rest(const Model& model, const Forces& forces, Vector theta, double t, const solver::Method& method, Work& work,
               Monitor& monitor) {
  std::vector<int> gamma, parts;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    parts.push_back(static_cast<int>(p));
    add_gamma(model, static_cast<int>(p), gamma);
  }
  const Condensation condensation(model.K.triangularView<Eigen::Lower>(), gamma);
  Interface interface(model, parts, gamma, condensation.schur());
  const Vector right = forces.f - model.G * theta;
  Fields out{{}, std::move(theta), std::vector<Vector>(model.parts.size())};
  out.u = condensation.recovered(right, interface.solve(condensation.condensed(right), resultants(model, parts, forces.f),
                                                        forces.supports, t, method, out.reactions, work, monitor));
  finish(model, out, parts);
  return out;
}

}  // namespace dotyk::thermoelastic

#include "solver/bounded/separable_set.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

void check_intervals(const Vector& low, const Vector& high) {
  if (low.size() != high.size())
    throw InputError(text("separable set: ", low.size(), " lower ends and ", high.size(), " upper ones"));
  for (Eigen::Index i = 0; i < low.size(); ++i)
    if (!(low[i] <= high[i]) || low[i] == kInfinity || high[i] == -kInfinity)
      throw InputError(text("separable set: component ", i, " has no point in [", low[i], ", ", high[i], "]"));
}

void check_discs(const Vector& low, const Vector& high, const std::vector<SeparableSet::Disc>& discs) {
  std::vector<char> taken(low.size(), 0);
  for (const auto& disc : discs) {
    if (!(disc.radius >= 0 && std::isfinite(disc.radius)) || !disc.centre.allFinite())
      throw InputError(text("separable set: a disc of radius ", disc.radius, " about ", disc.centre.transpose()));
    for (const int i : disc.both()) {
      if (i < 0 || i >= low.size() || taken[i]++)
        throw InputError(text("separable set: component ", i, " of a disc is not one of ", low.size(), " or has another"));
      if (low[i] != -kInfinity || high[i] != kInfinity)
        throw InputError(text("separable set: component ", i, " has a disc and an interval"));
    }
  }
}

/// The greatest s ≥ 0 with ‖u + s p‖ ≤ radius, for ‖u‖ ≤ radius; infinite for p = 0.
double room_in_disc(const Eigen::Vector2d& u, const Eigen::Vector2d& p, double radius) {
  const double a = p.squaredNorm(), b = u.dot(p), c = (u.norm() - radius) * (u.norm() + radius);
  if (a == 0) return kInfinity;
  // The root of as² + 2bs + c, in the form without cancellation.
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return std::max(0.0, b > 0 ? -c / (b + root) : (root - b) / a);
}

/// The point of the disc nearest to v = (x_i, x_j); drawn inward by rounding units until it is in it.
Eigen::Vector2d nearest(const SeparableSet::Disc& disc, const Eigen::Vector2d& v) {
  const Eigen::Vector2d u = v - disc.centre;
  const double length = u.norm();
  if (!(length > disc.radius)) return v;
  for (double shrink = 0; shrink < 1; shrink = std::max(kEpsilon, 2 * shrink)) {
    const Eigen::Vector2d point = disc.centre + disc.radius / length * (1 - shrink) * u;
    if ((point - disc.centre).norm() <= disc.radius) return point;
  }
  return disc.centre;
}

}  // namespace

SeparableSet::SeparableSet(Vector low, Vector high, std::vector<Disc> discs)
    : low_(std::move(low)), high_(std::move(high)), discs_(std::move(discs)) {
  check_intervals(low_, high_);
  check_discs(low_, high_, discs_);
  for (const Disc& disc : discs_)
    edge_.push_back(disc.radius - 16 * kEpsilon * (disc.radius + disc.centre.lpNorm<1>()));
}

Vector SeparableSet::project(Vector x) const {
  x = x.cwiseMax(low_).cwiseMin(high_);
  for (const Disc& disc : discs_) x(disc.both()) = nearest(disc, x(disc.both()));
  return x;
}

bool SeparableSet::contains(const Vector& x) const {
  return x.size() == size() && (x.array() >= low_.array()).all() && (x.array() <= high_.array()).all() &&
         std::all_of(discs_.begin(), discs_.end(), [&](const Disc& disc) { return offset(disc, x).norm() <= disc.radius; });
}

SeparableSet::Gradients SeparableSet::gradients(const Vector& x, const Vector& g) const {
  Gradients out{Vector::Zero(size()), Vector::Zero(size()), std::vector<Place>(size(), Place::active), {}};
  for (Eigen::Index i = 0; i < size(); ++i) {
    const bool lowest = x[i] <= low_[i], highest = x[i] >= high_[i];
    if (!lowest && !highest) {
      out.face[i] = Place::free;
      out.free[i] = g[i];
    } else if ((g[i] < 0 && !highest) || (g[i] > 0 && !lowest)) {
      out.chopped[i] = g[i];
    }
  }
  if (has_discs()) out.curvature = Vector::Zero(size());
  for (std::size_t k = 0; k < discs_.size(); ++k) classify(k, x, g, out);
  return out;
}

void SeparableSet::classify(std::size_t k, const Vector& x, const Vector& g, Gradients& out) const {
  const Disc& disc = discs_[k];
  const Eigen::Vector2d u = offset(disc, x), own = g(disc.both());
  const double length = u.norm();
  if (length < edge_[k]) return;
  const bool slides = disc.radius > 0 && length > 0;
  const Eigen::Vector2d n = slides ? Eigen::Vector2d(u / length) : Eigen::Vector2d(0, 0);
  const double inward = std::max(0.0, n.dot(own));
  out.slides = out.slides || slides;
  for (const int c : {0, 1}) {
    const int i = disc.both()[c];
    out.face[i] = slides ? Place::sliding : Place::active;
    out.free[i] = slides ? own[c] - n.dot(own) * n[c] : 0;
    out.chopped[i] = inward * n[c];
    out.curvature[i] = slides ? std::max(0.0, -n.dot(own)) / disc.radius : 0;
  }
}

Vector SeparableSet::tangential(const Vector& x, const Gradients& gradients, Vector v) const {
  for (Eigen::Index i = 0; i < size(); ++i)
    if (gradients.face[i] == Place::active) v[i] = 0;
  for (const Disc& disc : discs_) {
    if (gradients.face[disc.first] != Place::sliding) continue;
    const Eigen::Vector2d n = offset(disc, x).normalized();
    v(disc.both()) -= n.dot(v(disc.both())) * n;
  }
  return v;
}

algebra::SparseMatrix SeparableSet::directions(const Vector& x, const Gradients& at) const {
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (int i = 0; i < static_cast<int>(x.size()); ++i)
    if (at.face[i] == Place::free) entries.emplace_back(i, count++, 1.0);
  for (const Disc& disc : discs_) {
    if (at.face[disc.first] != Place::sliding) continue;
    const Eigen::Vector2d n = offset(disc, x).normalized();
    entries.emplace_back(disc.first, count, -n[1]);
    entries.emplace_back(disc.second, count++, n[0]);
  }
  algebra::SparseMatrix T(x.size(), count);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

Vector SeparableSet::reduced_free(const Vector& x, const Vector& free, double alpha) const {
  // (x − low)/α rather than a difference of points: exact far from the ends.
  Vector reduced = free.cwiseMin((x - low_) / alpha).cwiseMax((x - high_) / alpha);
  for (const Disc& disc : discs_) {
    const Eigen::Vector2d own = x(disc.both()), moved = own - alpha * free(disc.both()), point = nearest(disc, moved);
    if (point != moved) reduced(disc.both()) = (own - point) / alpha;
  }
  return reduced;
}

double SeparableSet::longest_step(const Vector& x, const Vector& p) const {
  double step = kInfinity;
  for (Eigen::Index i = 0; i < size(); ++i)
    if (p[i] != 0) step = std::min(step, (x[i] - (p[i] > 0 ? low_[i] : high_[i])) / p[i]);
  for (std::size_t k = 0; k < discs_.size(); ++k) {
    const Eigen::Vector2d own = p(discs_[k].both()), u = offset(discs_[k], x);
    if (own.isZero(0)) continue;
    const bool slides = u.norm() >= edge_[k] && u.dot(own) <= 0.5 * u.norm() * own.norm();
    step = std::min(step, slides ? discs_[k].radius / own.norm() : room_in_disc(u, -own, discs_[k].radius));
  }
  return step;
}

double SeparableSet::infimum(const Vector& w) const {
  const double nothing = 1e-10 * w.norm();
  double sum = 0;
  std::vector<char> in_disc(size(), 0);
  for (const Disc& disc : discs_) {
    const Eigen::Vector2d own = w(disc.both());
    sum += own.dot(disc.centre) - own.norm() * disc.radius;
    in_disc[disc.first] = in_disc[disc.second] = 1;
  }
  for (Eigen::Index i = 0; i < size(); ++i) {
    const double end = w[i] > 0 ? low_[i] : high_[i];
    if (in_disc[i] || w[i] == 0 || (std::isinf(end) && std::abs(w[i]) <= nothing)) continue;
    sum += w[i] * end;
  }
  return sum;
}

double SeparableSet::rounding(const Vector& g) const {
  double sum = 0;
  for (std::size_t k = 0; k < discs_.size(); ++k) sum += (discs_[k].radius - edge_[k]) * g(discs_[k].both()).norm();
  return sum;
}

Vector SeparableSet::along(const Vector& x, const Vector& p, double alpha) const {
  Vector y = x - alpha * p;
  for (Eigen::Index i = 0; i < size(); ++i) {
    if (p[i] == 0) continue;
    const double end = p[i] > 0 ? low_[i] : high_[i], left = p[i] > 0 ? y[i] - end : end - y[i];
    if (left <= 4 * kEpsilon * (std::abs(x[i]) + alpha * std::abs(p[i]))) y[i] = end;
  }
  return discs_.empty() ? y : project(std::move(y));
}

}  // namespace dotyk::solver

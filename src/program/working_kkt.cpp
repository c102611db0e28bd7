#include "program/working_kkt.hpp"

#include <random>
#include <stdexcept>

#include "program/certificate.hpp"

namespace dotyk::program {
namespace {

constexpr double kLeastRegularisation = 1e-14;     ///< least regularisation, in units of a scaled program
/// Regularisation of matrices that rounding spoils with less: where P is singular and rows are dependent,
/// pivots are differences of numbers of size 1/δ, and δ² has to stay well above the rounding unit.
constexpr double kSafe = 1e-7;
constexpr std::size_t kBorders = 60;   ///< changes before the next factorisation
constexpr double kRefined = 1e-13, kBordered = 1e-12, kConsistent = 1e-8;

}  // namespace

WorkingKkt::WorkingKkt(const QuadraticProgram& program)
    : p_(program), n_(program.unknowns()), m_(program.rows()), kkt_(program), taken_(m_, 0), random_(n_ + m_) {
  std::mt19937 engine(1);
  for (double& x : random_) x = engine() / 4294967296.0 - 0.5;
}

void WorkingKkt::change(int row, bool in) {
  if (taken_[row] == static_cast<char>(in)) return;
  taken_[row] = in;
  if (stale_) return;
  if (std::erase_if(border_, [row](const Border& b) { return b.row == row; }) == 0) {
    stale_ = border_.size() == kBorders;
    if (stale_) return;
    Vector column = Vector::Zero(n_ + m_);
    if (in) column.head(n_) = p_.A.row(row).transpose();
    else column[n_ + row] = 1;
    border_.push_back({row, in, kkt_.solve(column)});
  }
  form_schur();
}

void WorkingKkt::factor(double least) {
  for (delta_ = least; delta_ <= 1; delta_ *= 10) {
    ++factorisations_;
    if (!kkt_.factor(delta_, Vector::Constant(m_, delta_), taken_)) continue;
    border_.clear();
    least_ = delta_ >= kSafe ? kSafe : std::max(kLeastRegularisation, 0.1 * delta_);
    stale_ = false;
    return;
  }
  throw std::runtime_error("active set: the KKT matrix cannot be factored");
}

void WorkingKkt::form_schur() {
  const auto size = static_cast<Eigen::Index>(border_.size());
  algebra::DenseMatrix s(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) s(i, j) = border_[i].times(p_, border_[j].column);
    if (border_[i].in) s(i, i) += delta_;
  }
  if (size > 0) schur_ = algebra::Lu(std::move(s));
}

/// (p, y) of the regularised system; y of rows outside W is zero.
Vector WorkingKkt::regularised(const Vector& b) const {
  Vector base = b;
  for (const Border& k : border_) base[n_ + k.row] = 0;
  Vector z = kkt_.solve(base);
  if (!border_.empty()) {
    Vector t(static_cast<Eigen::Index>(border_.size()));
    for (std::size_t i = 0; i < border_.size(); ++i)
      t[i] = border_[i].times(p_, z) - (border_[i].in ? b[n_ + border_[i].row] : 0);
    t = schur_.solve(t);
    for (std::size_t i = 0; i < border_.size(); ++i) z -= t[i] * border_[i].column;
    for (std::size_t i = 0; i < border_.size(); ++i) z[n_ + border_[i].row] = border_[i].in ? t[i] : 0;
  }
  for (int r = 0; r < m_; ++r)
    if (!taken_[r]) z[n_ + r] = 0;
  return z;
}

Vector WorkingKkt::rhs(const Vector& f, const Vector& h) const {
  Vector b(n_ + m_);
  b << f, h;
  for (int r = 0; r < m_; ++r)
    if (!taken_[r]) b[n_ + r] = 0;
  return b;
}

/// A random vector grows by the inverse of the least eigenvalue.
bool WorkingKkt::probe() const {
  const Vector b = rhs(random_.head(n_), random_.tail(m_));
  return std::max(1e-9, delta_) * regularised(b).norm() > 0.05 * b.norm() / std::sqrt(1.0 + b.size());
}

WorkingKkt::Solution WorkingKkt::solve(const Vector& f, const Vector& h, const Vector& y0) {
  if (stale_) factor(std::max(least_, kLeastRegularisation));
  Vector known = y0;
  for (int r = 0; r < m_; ++r)
    if (!taken_[r]) known[r] = 0;
  const Vector b = rhs(f - p_.A.transpose() * known, h);
  const double size = std::max(peak(f), peak(rhs(f, h)));
  const auto K = [&](const Vector& z) { return kkt_times(p_, taken_, z); };
  const auto inverse = [&](const Vector& v) { return regularised(v); };
  const auto good = [&](const Refined& r) { return peak(r.residual) <= kConsistent * size && r.z.allFinite(); };
  Refined refined = refine(K, inverse, b, kRefined * size, 10);
  if (!border_.empty() && peak(refined.residual) > kBordered * size) {
    factor(least_);  // the border has lost digits
    refined = refine(K, inverse, b, kRefined * size, 10);
  }
  if (!good(refined) && delta_ < kSafe) {
    factor(std::max(kSafe, delta_));  // a pivot may have, too
    refined = refine(K, inverse, b, kRefined * size, 20);
  }
  Solution out;
  out.consistent = good(refined);
  out.singular = !out.consistent || probe();
  out.y = known + refined.z.tail(m_);
  out.p = refined.z.head(n_);
  if (out.consistent) return out;
  // Each solve multiplies the part in the kernel by 1/δ and leaves the rest behind.
  const auto K_regularised = [&](const Vector& z) {
    Vector out = K(z);
    out.head(n_) += delta_ * z.head(n_);
    out.tail(m_) -= delta_ * z.tail(m_);
    return out;
  };
  Vector z = inverse(b);
  for (int round = 0; round < 3; ++round) {
    const Vector start = rhs(z.head(n_) / peak(z.head(n_)), Vector::Zero(m_));
    z = inverse(start);
    z += inverse(start - K_regularised(z));
  }
  out.p = z.head(n_);
  return out;
}

Vector WorkingKkt::restore(const Vector& h) {
  const QuadraticProgram nearest = nearest_point(p_);
  Kkt kkt(nearest);
  const double delta = 1e-8;
  if (!kkt.factor(delta, Vector::Constant(m_, delta), taken_)) return Vector::Zero(n_);
  const Vector b = rhs(Vector::Zero(n_), h);
  return refine([&](const Vector& z) { return kkt_times(nearest, taken_, z); },
                [&](const Vector& v) { return kkt.solve(v); }, b, kRefined * peak(b), 10).z.head(n_);
}

}  // namespace dotyk::program

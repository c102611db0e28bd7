#include "program/active_set_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "program/certificate.hpp"

namespace dotyk::program {
namespace {

constexpr double kHeavier = 100;     ///< factor on the weight of violations
constexpr double kHeaviest = 100;    ///< on its first value, before violations alone are minimised
constexpr double kFar = 1e9;         ///< a step this much longer than x runs along the kernel
constexpr double kCurved = 1e-12;    ///< curvature along a direction, relative to its rounding terms
constexpr double kSmall = 1e-6;      ///< greatest correction of a solution, relative to x
constexpr double kStill = 1e-11;     ///< a step this much shorter than x is none
constexpr int kRounds = 50;           ///< in which the whole working set changes at once, at most
constexpr int kLeaves = 10;          ///< times a row may leave among many before rows change one by one

}  // namespace

ActiveSetIteration::ActiveSetIteration(const QuadraticProgram& p, const ActiveSet& settings, Monitor& monitor)
    : p_(p), settings_(settings), monitor_(monitor), kkt_(p), rows_(p, settings.tol), x_(Vector::Zero(p.unknowns())),
      y_(Vector::Zero(p.rows())), sizes_(p.P.cwiseAbs()), left_(p.rows(), 0) {}

Result ActiveSetIteration::run(const std::vector<Side>& start, const Vector& x, const Vector& y) {
  rows_.side = start;
  x_ = x, y_ = y;
  scale_ = peak(p_.q);
  weight_ = first_weight_ = 10 * std::max({1.0, peak(p_.q), peak(y)});
  if (settings_.change != ActiveSet::Change::many || !whole_sets()) {
    begin();
    while (!finished_) {
      const bool before = zigzag_;
      iterate();
      if (zigzag_ == before || finished_) continue;
      // Where rows leave again and again the multipliers are rounding, and so is the point: from the start.
      rows_.side = start;
      x_ = x, y_ = y;
      weight_ = first_weight_;
      objective_ = true;
      forget();
      begin();
    }
  }
  if (result_.status == Status::solved) polish();
  result_.x = x_;
  result_.y = y_;
  result_.working = rows_.side;
  result_.factorisations += kkt_.factorisations();
  return result_;
}

Vector ActiveSetIteration::gradient() const {
  Vector g = objective_ ? Vector(times(p_.P, x_) + p_.q) : Vector(Vector::Zero(p_.unknowns()));
  if (rows_.violations()) g += weight_ * (p_.A.transpose() * rows_.charge());
  return g;
}

void ActiveSetIteration::finish(Status status, std::string reason) {
  result_.status = status;
  result_.reason = std::move(reason);
  finished_ = true;
}

WorkingKkt::Solution ActiveSetIteration::solve_kkt(const Vector& g, const Vector& activity) {
  ++result_.iterations;
  Vector missing = rows_.missing(activity);
  // Where violations alone count a step has no natural length: rows are not brought back on its way.
  restoring_ = peak(missing) > settings_.tol * (1 + peak(activity));
  if (!objective_ && !restoring_) missing.setZero();
  const auto s = kkt_.solve(-g, missing, y_);
  result_.singular += s.singular;
  result_.survived += s.singular && s.p.allFinite();
  return s;
}

void ActiveSetIteration::polish() {
  const auto off = [&] { return std::max(peak(gradient() + p_.A.transpose() * y_), peak(rows_.missing(p_.A * x_))); };
  const double before = off();
  const auto s = kkt_.solve(-gradient(), rows_.missing(p_.A * x_), y_);
  const bool small = peak(s.p) <= kSmall * (1 + peak(x_)) && peak(s.y - y_) <= kSmall * (1 + peak(y_));
  if (!s.consistent || !small) return;
  const Vector x = x_, y = y_;
  x_ += s.p;
  y_ = s.y;
  if (!(off() < before)) x_ = x, y_ = y;
}

bool ActiveSetIteration::whole_sets() {
  const auto side = rows_.side;
  const Vector x = x_, y = y_;
  std::unordered_set<std::size_t> seen;
  kkt_.set(rows_.taken());
  for (int round = 0; round < kRounds && seen.insert(rows_.hash()).second; ++round) {
    const auto s = solve_kkt(times(p_.P, x_) + p_.q, p_.A * x_);
    if (!s.consistent) {
      if (!fall(s.p)) break;
      continue;
    }
    x_ += s.p;
    y_ = s.y;
    int changed = 0;
    const Vector activity = p_.A * x_;
    for (int r = 0; r < p_.rows(); ++r) {
      const Side before = rows_.side[r];
      if (rows_.working(r)) {
        if (wrong(r) > 0 && !p_.equality(r)) rows_.side[r] = Side::free, ++result_.dropped;
      } else if (activity[r] > p_.high[r] + rows_.slack_tolerance(p_.high[r])) {
        rows_.side[r] = p_.equality(r) ? Side::equal : Side::high, ++result_.added;
      } else if (activity[r] < p_.low[r] - rows_.slack_tolerance(p_.low[r])) {
        rows_.side[r] = p_.equality(r) ? Side::equal : Side::low, ++result_.added;
      }
      changed += rows_.side[r] != before;
    }
    report(changed, s.p);
    if (changed == 0) {
      finish(Status::solved, "every row and every multiplier has its sign");
      return true;
    }
    kkt_.set(rows_.taken());
  }
  result_.repeats += seen.count(rows_.hash()) > 0;
  rows_.side = side;
  x_ = x, y_ = y;
  return false;
}

bool ActiveSetIteration::fall(const Vector& kernel) {
  const Vector p = kernel / peak(kernel), g = gradient(), speed = p_.A * p;
  const bool moves_rows = [&] {
    for (int r = 0; r < p_.rows(); ++r)
      if (rows_.working(r) && std::abs(speed[r]) > settings_.tol) return true;
    return false;
  }();
  if (!p.allFinite() || moves_rows || !(-g.dot(p) > settings_.tol * (1 + peak(g)))) return false;
  const auto meeting = rows_.meeting(p_.A * x_, speed, p_.A.cwiseAbs() * p.cwiseAbs(), false, true);
  if (!std::isfinite(meeting.step)) return false;
  x_ += meeting.step * p;
  for (int r : meeting.rows) rows_.engage(r, speed[r]), ++result_.added;
  report(static_cast<int>(meeting.rows.size()), meeting.step * p);
  kkt_.set(rows_.taken());
  return true;
}

void ActiveSetIteration::begin() {
  if (!begin_feasible()) settle();
}

bool ActiveSetIteration::begin_feasible() {
  if (settings_.point.size() == 0) return false;
  const auto side = rows_.side;
  rows_.classify(p_.A * x_);
  if (rows_.violations() > 0) {
    rows_.side = side;
    return false;
  }
  kkt_.set(rows_.taken());
  return true;
}

void ActiveSetIteration::settle() {
  kkt_.set(rows_.taken());
  const Vector activity = p_.A * x_;
  const auto s = solve_kkt(times(p_.P, x_) + p_.q, activity);
  if (s.consistent) x_ += s.p, y_ = s.y;
  else x_ += kkt_.restore(rows_.missing(activity));
  rows_.classify(p_.A * x_);
  kkt_.set(rows_.taken());
}

void ActiveSetIteration::iterate() {
  if (monitor_.stop()) return finish(Status::stopped, "stopped on request");
  if (result_.iterations >= settings_.max_iterations)
    return finish(Status::stopped, text("no end within ", settings_.max_iterations, " iterations"));
  const bool elastic = rows_.violations() > 0;
  if (!elastic && !objective_) objective_ = true, forget();
  const Vector g = gradient(), activity = p_.A * x_;
  auto s = solve_kkt(g, activity);
  if (peak(s.p) > kFar * (1 + peak(x_))) s.consistent = false;
  double fall = -g.dot(s.p), curvature = objective_ ? s.p.dot(times(p_.P, s.p)) : 0;
  const double still = kStill * (1 + peak(x_));
  double whole = s.consistent && (objective_ || restoring_) ? 1 : INFINITY;
  // −Pp is what is left of the gradient; the violations' one has size 1.
  const bool flat = objective_ ? std::abs(fall) <= 1e-14 * (1 + std::abs(objective(p_, x_)))
                               : peak(times(p_.P, s.p)) <= settings_.tol * (1 + peak(g));
  if (s.consistent && (peak(s.p) <= still || (flat && !restoring_))) {
    const Vector speed = p_.A * s.p;
    if (peak(s.p) <= still || rows_.meeting(activity, speed, p_.A.cwiseAbs() * s.p.cwiseAbs(), cautious_, many()).step >= 1) x_ += s.p;
    y_ = s.y;
    return stationary(elastic, s.p);
  }
  if (!s.consistent && restoring_) {
    rows_.classify(activity);  // rows at work contradict one another: those that do not hold are violated ones
    kkt_.set(rows_.taken());
    return;
  }
  if (!s.consistent) {
    s.p /= peak(s.p);
    fall = -g.dot(s.p), curvature = objective_ ? s.p.dot(times(p_.P, s.p)) : 0;
    if (!(fall > settings_.tol * (1 + peak(g)))) {  // stationary up to the tolerance on multipliers
      y_ = s.y;
      return stationary(elastic, s.p);
    }
    if (curvature > kCurved * s.p.cwiseAbs().dot(times(sizes_, s.p.cwiseAbs()))) whole = fall / curvature;
  }
  advance(s, whole, elastic, activity);
}

void ActiveSetIteration::advance(const WorkingKkt::Solution& s, double whole, bool elastic, const Vector& activity) {
  const double still = kStill * (1 + peak(x_));
  const Vector speed = p_.A * s.p;
  const auto meeting = rows_.meeting(activity, speed, p_.A.cwiseAbs() * s.p.cwiseAbs(), cautious_, many());
  // Curvature along a kernel direction may be rounding; the proof does not look at it.
  const bool endless = !std::isfinite(whole) || (!s.consistent && objective_ && !elastic && proves_unbounded(p_, s.p));
  if (endless && !std::isfinite(meeting.step)) {
    if (elastic) return heavier();
    result_.direction = s.p;
    return finish(Status::unbounded, "the objective falls for ever along a direction that meets no row");
  }
  const double step = std::min(whole, meeting.step);
  x_ += step * s.p;
  if (step * peak(s.p) > still) forget();
  if (whole <= meeting.step) {
    y_ = s.y;
    if (s.consistent) return stationary(elastic, s.p);
    return report(0, s.p);
  }
  for (int r : meeting.rows) {
    rows_.engage(r, speed[r]);
    kkt_.change(r, true);
    ++result_.added;
  }
  if (step == 0) blocked_ = true;
  report(static_cast<int>(meeting.rows.size()), s.p);
  remember();
}

bool ActiveSetIteration::many() const { return settings_.change == ActiveSet::Change::many && !blocked_ && !cautious_ && !zigzag_; }

double ActiveSetIteration::wrong(int r) const {
  const double y = y_[r], tolerance = settings_.tol * (1 + scale_);
  double out = 0;
  if (rows_.side[r] == Side::low && y > tolerance) out = y;
  if (rows_.side[r] == Side::high && y < -tolerance) out = -y;
  return out;
}

bool ActiveSetIteration::too_heavy(int r) const { return std::abs(y_[r]) > weight_ * (1 + 1e-9) && wrong(r) == 0; }

void ActiveSetIteration::stationary(bool elastic, const Vector& step) {
  double worst = 0;
  int leaving = -1;
  for (int r = 0; r < p_.rows(); ++r) {
    if (!rows_.working(r)) continue;
    const double size = wrong(r) > 0 ? wrong(r) : elastic && too_heavy(r) ? std::abs(y_[r]) - weight_ : 0;
    if (size > worst && (leaving < 0 || !cautious_)) worst = size, leaving = r;
  }
  if (leaving < 0) {
    report(0, step);
    if (!elastic) return finish(Status::solved, "every row and every multiplier has its sign");
    return heavier();
  }
  int count = 0;
  const bool all = many();
  for (int r = 0; r < p_.rows(); ++r) {
    const bool leaves = r == leaving || (all && rows_.working(r) && wrong(r) >= 0.1 * worst && wrong(r) > 0);
    if (!leaves) continue;
    if (all && ++left_[r] > kLeaves && !zigzag_) zigzag_ = true, ++result_.repeats;
    rows_.side[r] = wrong(r) > 0 ? Side::free : y_[r] > 0 ? Side::above : Side::below;
    kkt_.change(r, false);
    ++result_.dropped, ++count;
  }
  blocked_ = false;
  report(count, step);
  remember();
}

void ActiveSetIteration::heavier() {
  forget();
  if (rows_.arrived(p_.A * x_)) {
    for (int r = 0; r < p_.rows(); ++r)
      if (rows_.violated(r)) rows_.engage(r, 0), kkt_.change(r, true), ++result_.added;
    return;
  }
  if (!objective_) {
    // Their multipliers once more, where P does not matter: A'y = 0 as well as it can be.
    const QuadraticProgram nearest = nearest_point(p_);
    WorkingKkt exact(nearest);
    exact.set(rows_.taken());
    const Vector charge = rows_.charge();
    y_ = exact.solve(-(p_.A.transpose() * charge), Vector::Zero(p_.rows()), y_).y;
    result_.direction = y_ + charge;
    return finish(Status::infeasible, "the rows contradict one another");
  }
  if (weight_ < kHeaviest * first_weight_) {
    weight_ *= kHeavier;
    return;
  }
  objective_ = false;
  y_ /= weight_;
  weight_ = 1;
}

void ActiveSetIteration::forget() {
  seen_.clear();
  cautious_ = blocked_ = false;
}

void ActiveSetIteration::remember() {
  if (cautious_ || seen_.insert(rows_.hash()).second) return;
  cautious_ = true;
  ++result_.repeats;
}

void ActiveSetIteration::report(int changed, const Vector& step) {
  IterationInfo info;
  info.iteration = result_.iterations;
  for (int r = 0; r < p_.rows(); ++r) info.active += rows_.working(r);
  info.changed = changed;
  info.residual = peak(step) / (1 + peak(x_));
  info.seconds = clock_.seconds();
  monitor_.iteration(info);
}

}  // namespace dotyk::program

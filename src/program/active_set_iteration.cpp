#include "program/active_set_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "program/certificate.hpp"
#include "program/elastic.hpp"
#include "program/working_kkt.hpp"

namespace dotyk::program {
namespace {

constexpr double kHeavier = 100;     ///< factor on the weight of violations
constexpr double kHeaviest = 100;    ///< on its first value, before violations alone are minimised
constexpr double kFar = 1e9;         ///< a step this much longer than x runs along the kernel
constexpr double kCurved = 1e-12;    ///< curvature along a direction, relative to its rounding terms
constexpr double kSmall = 1e-6;      ///< greatest correction of a solution, relative to x
constexpr double kStill = 1e-11;     ///< a step this much shorter than x is none
constexpr int kRounds = 50;          ///< in which the whole working set changes at once, at most
constexpr int kLeaves = 10;          ///< times a row may leave among many before rows change one by one

class ActiveSetRun {
 public:
  ActiveSetRun(const QuadraticProgram& p, const ActiveSet& settings, const ActiveSetStart& start, Monitor& monitor)
      : p_(p), settings_(settings), start_(start), monitor_(monitor), kkt_(p), rows_(p, settings.tol), x_(start.x),
        y_(start.y), sizes_(p.P.cwiseAbs()), left_(p.rows(), 0), scale_(peak(p.q)),
        first_weight_(10 * std::max({1.0, scale_, peak(start.y)})) {}

  Result run() {
    if (settings_.change != ActiveSet::Change::many || !whole_sets()) {
      begin();
      while (!finished_) {
        const bool before = zigzag_;
        step();
        // Where rows leave again and again the multipliers are rounding, and so is the point: from the start.
        if (zigzag_ != before && !finished_) begin();
      }
    }
    if (result_.status == Status::solved) polish();
    result_.x = x_;
    result_.y = y_;
    result_.working = rows_.side;
    result_.factorisations += kkt_.factorisations();
    return result_;
  }

 private:
  Vector gradient() const {
    Vector g = objective_ ? Vector(times(p_.P, x_) + p_.q) : Vector(Vector::Zero(p_.unknowns()));
    if (rows_.any_violated()) g += weight_ * (p_.A.transpose() * rows_.charge());
    return g;
  }

  void finish(Status status, std::string reason) {
    result_.end(status, std::move(reason));
    finished_ = true;
  }

  WorkingKkt::Solution solve_kkt(const Vector& g) {
    ++result_.iterations;
    const Vector activity = p_.A * x_;
    Vector missing = rows_.missing(activity);
    // Where violations alone count a step has no natural length: rows are not brought back on its way.
    restoring_ = peak(missing) > settings_.tol * (1 + peak(activity));
    if (!objective_ && !restoring_) missing.setZero();
    const auto s = kkt_.solve(-g, missing, y_);
    result_.singular += s.singular;
    result_.survived += s.singular && s.p.allFinite();
    return s;
  }

  /// A last correction of the solution, of the size of what refinement left.
  void polish() {
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

  /// Rounds in which every violated row goes to work and every wrong multiplier leaves. True if they end
  /// at the solution.
  bool whole_sets() {
    std::unordered_set<std::size_t> seen;
    rows_.side = start_.working;
    kkt_.set(rows_.taken());
    for (int round = 0; round < kRounds && seen.insert(rows_.hash()).second; ++round) {
      const auto s = solve_kkt(gradient());
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
        } else {
          rows_.let_go(r, activity[r]);
          if (rows_.violated(r)) rows_.engage(r, 0), ++result_.added;
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
    return false;
  }

  /// Of a set that leaves a motion free: along it, downhill, to the first rows met, which go to work. False where
  /// it is no such motion, or meets no row.
  bool fall(const Vector& kernel) {
    const Vector p = kernel / peak(kernel), g = gradient();
    if (!p.allFinite() || !(-g.dot(p) > settings_.tol * (1 + peak(g)))) return false;
    const auto meeting = rows_.meeting(x_, p, false, true);
    for (int r = 0; r < p_.rows(); ++r)
      if (rows_.working(r) && std::abs(meeting.speed[r]) > settings_.tol) return false;
    if (!std::isfinite(meeting.step)) return false;
    x_ += meeting.step * p;
    engage(meeting);
    report(static_cast<int>(meeting.rows.size()), meeting.step * p);
    kkt_.set(rows_.taken());
    return true;
  }

  void engage(const Elastic::Meeting& meeting) {
    for (int r : meeting.rows) rows_.engage(r, meeting.speed[r]), ++result_.added;
  }

  /// From the start. At a point given at which no row is violated, the rows that hold go to work; else
  /// rows at work hold at the first point as well as they can, and the rest is looked at.
  void begin() {
    x_ = start_.x, y_ = start_.y;
    weight_ = first_weight_;
    objective_ = true;
    forget();
    rows_.side = start_.working;
    if (settings_.point.size() > 0) {
      rows_.classify(p_.A * x_);
      if (!rows_.any_violated()) return kkt_.set(rows_.taken());
      rows_.side = start_.working;
    }
    kkt_.set(rows_.taken());
    const auto s = solve_kkt(gradient());
    if (s.consistent) x_ += s.p, y_ = s.y;
    else x_ += kkt_.restore(rows_.missing(p_.A * x_));
    rows_.classify(p_.A * x_);
    kkt_.set(rows_.taken());
  }

  void step() {
    if (monitor_.stop()) return finish(Status::stopped, "stopped on request");
    if (result_.iterations >= settings_.max_iterations)
      return finish(Status::stopped, text("no end within ", settings_.max_iterations, " iterations"));
    const bool elastic = rows_.any_violated();
    if (!elastic && !objective_) objective_ = true, forget();
    const Vector g = gradient();
    auto s = solve_kkt(g);
    if (peak(s.p) > kFar * (1 + peak(x_))) s.consistent = false;
    double fall = -g.dot(s.p);
    const double still = kStill * (1 + peak(x_));
    // −Pp is what is left of the gradient; the violations' one has size 1.
    const bool flat = objective_ ? std::abs(fall) <= 1e-14 * (1 + std::abs(objective(p_, x_)))
                                 : peak(times(p_.P, s.p)) <= settings_.tol * (1 + peak(g));
    if (s.consistent && (peak(s.p) <= still || (flat && !restoring_))) {
      if (peak(s.p) <= still || rows_.meeting(x_, s.p, cautious_, many()).step >= 1) x_ += s.p;
      y_ = s.y;
      return stationary(elastic, s.p);
    }
    if (!s.consistent && restoring_) {
      rows_.classify(p_.A * x_);  // rows at work contradict one another: those that do not hold are violated ones
      return kkt_.set(rows_.taken());
    }
    double whole = s.consistent && (objective_ || restoring_) ? 1 : INFINITY;
    if (!s.consistent) {
      s.p /= peak(s.p);
      fall = -g.dot(s.p);
      if (!(fall > settings_.tol * (1 + peak(g)))) {  // stationary up to the tolerance on multipliers
        y_ = s.y;
        return stationary(elastic, s.p);
      }
      const double curvature = objective_ ? s.p.dot(times(p_.P, s.p)) : 0;
      if (curvature > kCurved * s.p.cwiseAbs().dot(times(sizes_, s.p.cwiseAbs()))) whole = fall / curvature;
    }
    advance(s, whole, elastic);
  }

  /// Goes along s.p to the end of its step (`whole`, infinite where it has none) or to the first rows met,
  /// which go to work.
  void advance(const WorkingKkt::Solution& s, double whole, bool elastic) {
    const double still = kStill * (1 + peak(x_));
    const auto meeting = rows_.meeting(x_, s.p, cautious_, many());
    // Curvature along a kernel direction may be rounding; the proof does not look at it.
    const bool endless = !std::isfinite(whole) || (!s.consistent && objective_ && !elastic && proves_unbounded(p_, s.p));
    const double length = std::min(whole, meeting.step);
    // Further away rounding of x is no longer small beside the tolerance of rows: first it matters whether there is a feasible point at all.
    const double farthest = 0.01 * settings_.tol / std::numeric_limits<double>::epsilon();
    if (elastic && (!std::isfinite(length) || (objective_ && !s.consistent && length > farthest))) return heavier();
    if (endless && !std::isfinite(meeting.step)) {
      result_.direction = s.p;
      return finish(Status::unbounded, kFallsForEver);
    }
    x_ += length * s.p;
    if (length * peak(s.p) > still) forget();
    if (whole <= meeting.step) {
      y_ = s.y;
      return s.consistent ? stationary(elastic, s.p) : report(0, s.p);
    }
    engage(meeting);
    for (int r : meeting.rows) kkt_.change(r, true);
    if (length == 0) blocked_ = true;
    report(static_cast<int>(meeting.rows.size()), s.p);
    remember();
  }

  bool many() const { return settings_.change == ActiveSet::Change::many && !blocked_ && !cautious_ && !zigzag_; }

  /// How wrong the multiplier of a row at work is, 0 where it is right.
  double wrong(int r) const {
    const double y = rows_.side[r] == Side::low ? y_[r] : rows_.side[r] == Side::high ? -y_[r] : 0;
    return y > settings_.tol * (1 + scale_) ? y : 0;
  }

  /// The objective cannot fall with this working set: rows with wrong multipliers leave; where there are elastic rows,
  /// multipliers beyond their weight are wrong as well.
  void stationary(bool elastic, const Vector& step) {
    double worst = 0;
    int leaving = -1;
    for (int r = 0; r < p_.rows(); ++r) {
      if (!rows_.working(r)) continue;
      const bool too_heavy = elastic && std::abs(y_[r]) > weight_ * (1 + 1e-9);
      const double size = wrong(r) > 0 ? wrong(r) : too_heavy ? std::abs(y_[r]) - weight_ : 0;
      if (size > worst && (leaving < 0 || !cautious_)) worst = size, leaving = r;
    }
    if (leaving < 0) {
      report(0, step);
      return elastic ? heavier() : finish(Status::solved, "every row and every multiplier has its sign");
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

  /// Violations are left where nothing else is wrong: they are made dearer; at last they alone count.
  void heavier() {
    forget();
    if (rows_.arrived(p_.A * x_)) {
      for (int r = 0; r < p_.rows(); ++r)
        if (rows_.violated(r)) rows_.engage(r, 0), kkt_.change(r, true), ++result_.added;
    } else if (!objective_) {
      // Their multipliers once more, where P does not matter: A'y = 0 as well as it can be.
      const QuadraticProgram nearest = nearest_point(p_);
      WorkingKkt exact(nearest);
      exact.set(rows_.taken());
      const Vector charge = rows_.charge();
      y_ = exact.solve(-(p_.A.transpose() * charge), Vector::Zero(p_.rows()), y_).y;
      result_.direction = y_ + charge;
      finish(Status::infeasible, "the rows contradict one another");
    } else if (weight_ < kHeaviest * first_weight_) {
      weight_ *= kHeavier;
    } else {
      objective_ = false;
      y_ /= weight_;
      weight_ = 1;
    }
  }

  void forget() {
    seen_.clear();
    cautious_ = blocked_ = false;
  }

  void remember() {
    if (cautious_ || seen_.insert(rows_.hash()).second) return;
    cautious_ = true;
    ++result_.repeats;
  }

  void report(int changed, const Vector& step) {
    IterationInfo info;
    info.iteration = result_.iterations;
    for (int r = 0; r < p_.rows(); ++r) info.active += rows_.working(r);
    info.changed = changed;
    info.residual = peak(step) / (1 + peak(x_));
    info.seconds = clock_.seconds();
    monitor_.iteration(info);
  }

  const QuadraticProgram& p_;
  const ActiveSet& settings_;
  const ActiveSetStart& start_;
  Monitor& monitor_;
  Stopwatch clock_;
  WorkingKkt kkt_;
  Elastic rows_;
  Vector x_, y_;
  SparseMatrix sizes_;  ///< |P|
  Result result_;
  std::unordered_set<std::size_t> seen_;  ///< working sets since the objective last fell
  bool finished_ = false, objective_ = true, cautious_ = false, blocked_ = false, zigzag_ = false;
  bool restoring_ = false;  ///< rows at work have drifted from their limits
  std::vector<int> left_;  ///< how often each row has left among many
  double scale_, first_weight_, weight_ = 1;
};

}  // namespace

Result iterate(const QuadraticProgram& p, const ActiveSet& settings, const ActiveSetStart& start, Monitor& monitor) {
  return ActiveSetRun(p, settings, start, monitor).run();
}

}  // namespace dotyk::program

#pragma once

#include <unordered_set>

#include "base/stopwatch.hpp"
#include "program/active_set.hpp"
#include "program/elastic.hpp"
#include "program/working_kkt.hpp"

namespace dotyk::program {

/// The steps of the active-set method on a scaled program; see active_set.hpp for what it does.
class ActiveSetIteration {
 public:
  ActiveSetIteration(const QuadraticProgram& p, const ActiveSet& settings, Monitor& monitor);

  /// From sides of all rows (m), x (n) and multipliers (m).
  Result run(const std::vector<Side>& start, const Vector& x, const Vector& y);

 private:
  Vector gradient() const;
  void finish(Status status, std::string reason);
  WorkingKkt::Solution solve_kkt(const Vector& g, const Vector& activity);
  /// Rounds in which every violated row goes to work and every wrong multiplier leaves. True if they end
  /// at the solution; else the start is put back.
  bool whole_sets();
  /// A last correction of the solution, of the size of what refinement left.
  void polish();
  /// Of a set that leaves a motion free: along it, downhill, to the first rows met, which go to work. False where
  /// it is no such motion, or meets no row.
  bool fall(const Vector& kernel);
  void begin();
  /// Puts the rows that hold at the point given to work; false, and nothing changed, where some row is violated.
  bool begin_feasible();
  /// The first point: rows at work hold there as well as they can; the rest is looked at.
  void settle();
  void iterate();
  /// Goes along s.p to the end of its step (`whole`, infinite where it has none) or to the first rows met,
  /// which go to work.
  void advance(const WorkingKkt::Solution& s, double whole, bool elastic, const Vector& activity);
  bool many() const;
  /// How wrong the multiplier of a row at work is, 0 where it is right; negative multipliers beyond the
  /// weight of an elastic row are wrong as well.
  double wrong(int r) const;
  bool too_heavy(int r) const;
  /// The objective cannot fall with this working set: rows with wrong multipliers leave.
  void stationary(bool elastic, const Vector& step);
  /// Violations are left where nothing else is wrong: they are made dearer; at last they alone count.
  void heavier();
  void forget();
  void remember();
  void report(int changed, const Vector& step);

  const QuadraticProgram& p_;
  const ActiveSet& settings_;
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
  double weight_ = 1, first_weight_ = 1, scale_ = 0;
};

}  // namespace dotyk::program

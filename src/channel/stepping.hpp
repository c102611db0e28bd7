#pragma once

#include <memory>

#include "algebra/direct/sparse_lu.hpp"
#include "base/monitor.hpp"
#include "channel/data.hpp"
#include "channel/elements.hpp"

namespace dotyk::channel {

/// The modified Hartmann problem by finite elements in y (order degree + 1) and Radau IIA with three
/// stages in t (order 5, L-stable: the kink that the initial profile makes with the walls dies out).
/// Knows nothing of the series: the two check each other. Starts from the projection of the initial profile.
class Stepping {
 public:
  /// Throws InputError: data as check(), cells and degree as Elements, step positive and finite.
  Stepping(const Data& data, double step, int cells = 16, int degree = 8);

  void step();  ///< by one step
  /// By equal steps, none longer than the step, to this time, not before now. Throws Interrupted where the monitor asks to
  /// stop: it is at the time reached then, and can go on from it.
  void advance(double time, Monitor& monitor);

  double time() const { return time_; }
  long long steps() const { return steps_; }
  double velocity(double y) const;  ///< now; throws InputError for |y| > y0
  const Data& data() const { return data_; }

 private:
  void step(double length);
  void factor(double length);

  Data data_;
  double step_, time_ = 0;
  long long steps_ = 0;
  Elements elements_;
  algebra::Vector u_;
  struct Factor {
    algebra::SparseMatrix matrix;  // the factor refers to it
    algebra::SparseLu lu{matrix};
  };
  std::unique_ptr<const Factor> factor_;
  double factored_ = 0;  // the length of step that factor_ is for, 0: none
};

}  // namespace dotyk::channel

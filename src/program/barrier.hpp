#pragma once

#include <vector>

#include "program/program.hpp"

namespace dotyk::program {

/// Mehrotra's predictor–corrector method (1992) with Gondzio's centrality corrections (1996), whatever linear algebra solves
/// for its steps. Unknowns w have limits low ≤ w ≤ high. Each finite one has a sign σ, 1 if low and −1 if high, a slack s
/// and a multiplier z > 0,
///   s = σ(w − limit),   s z = μ → 0,   y = −Σ σz;
/// what derives knows the equations that bind w and y to each other, and to other unknowns x. Slacks are unknowns of their own: w − low
/// would lose its digits. Once s and z are eliminated, a step has
///   dy = θ dw + κ,   θ = Σ z/s,
/// where w has limits. Where low = high or both are infinite there is no pair s, z, and y is for the equations to say.
class Barrier {
 public:
  struct Point {
    Vector w, y;  ///< m
    Vector s, z;  ///< one a limit
    Vector x;
  };
  virtual ~Barrier() = default;

  /// The residuals at the point, which step() goes by. What derives adds those of its equations.
  virtual void evaluate();
  /// False where a linear system cannot be factored or the step is not finite.
  bool step();

  const Point& point() const { return at_; }
  /// The last step's direction: of iterates that go to infinity it is the cleaner proof.
  const Point& last() const { return last_; }
  /// The mean of s z, which is μ.
  double gap() const { return mu_; }
  /// Has one of s and z ceased to fall in every pair in the last step, while the other falls on?
  bool decided() const;
  /// Which limit w ends at: where s fell by more in the last step than z, whatever their units. `y`: what its multiplier
  /// adds to y.
  struct End {
    Side side = Side::free;
    double y = 0;
  };
  std::vector<End> ends() const;

 protected:
  Barrier(Vector low, Vector high);
  /// w as near to `towards` as `room` from its limits allows, or a quarter of their distance where that is less; all s z are `unit`,
  /// beside which μ is small or not.
  void place(const Vector& towards, double room, double unit);
  /// Gets ready to solve with θ (m, zero where w has no limits); false where that cannot be done.
  virtual bool factor(const Vector& theta) = 0;
  /// dw, dx, and dy where w has no limits, for κ (m) and the θ before.
  virtual void solve(const Vector& kappa, Point& step) = 0;
  /// Sets y by z where w has limits.
  void take_multipliers(Point& at) const;
  int rows() const { return static_cast<int>(low_.size()); }

  const Vector low_, high_;
  std::vector<char> limited_;  ///< m: has w limits?
  std::vector<int> row_;       ///< of each limit, ascending; low before high
  Vector sign_, limit_;        ///< of each limit
  Vector rs_;                  ///< residuals of the slacks
  double complementary_ = 0;   ///< the sum of s z
  Point at_;

 private:
  Point direction(Vector c);
  double longest(const Point& d) const;

  double mu_ = 0, unit_ = 1;
  Point last_, before_;  ///< the last direction, and where it began
};

}  // namespace dotyk::program

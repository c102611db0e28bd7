#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dotyk::problem {

/// What a row or contact node does, as reported.
enum class Status { open, closed, stick, slip };

const char* status_name(Status status);

/// λ = P(y) at y = λ + ρx, and the derivative of P there.
struct Projection {
  double lambda;
  double slope;  ///< in [0, 1]; one element of the generalised derivative at a kink
};

/// Of multipliers that a law can give, the domain of φ*, or of displacements. Ends may be infinite.
struct Interval {
  double low, high;
};

/// k of φ*(λ) = λ²/2k for λ < 0 and for λ > 0; infinite: φ* = 0 there.
struct Springs {
  double below, above;
};

/// λ at a displacement x and dλ/dx there: infinite where x is held, at a kink that of one side.
struct Response {
  double force, slope;
};

/// An interface law φ on one row: λ ∈ ∂φ(x), x = (Bu − c)_r. Unit of λ: that of
/// f (force, integrated over the node's share of the boundary); of x: of u.
///
/// λ ∈ ∂φ(x) is equivalent to λ = P(λ + ρx) for every ρ > 0, with P the law's
/// projection, the proximal map of ρφ*; a law knows no solver.
/// What it must tell is pure. What it may tell is absent unless it does: methods that need that refuse the law by name
/// before they begin (solver/core/treatable.hpp).
class Law {
 public:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  virtual ~Law() = default;
  virtual std::string name() const = 0;
  /// P(y) for the row of the law's group, ρ ≥ 0 in force per displacement; at ρ = 0 the nearest admissible λ.
  virtual Projection project(int row, double y, double rho) const = 0;
  /// φ(x); 0 where an indicator law holds (a solver's iterate may violate it by rounding).
  virtual double energy(int row, double x) const = 0;
  /// φ*(λ), the conjugate energy, for an admissible λ.
  virtual double conjugate(int row, double lambda) const = 0;
  /// Every multiplier that the row can carry.
  virtual Interval multipliers(int row) const = 0;
  /// λ ≥ 0 pushes, and only where x reaches 0: penetration and complementarity are defined.
  virtual bool unilateral() const { return false; }
  /// Of φ* on multipliers(), where that is one parabola or two: λ(x) is then piecewise linear.
  virtual std::optional<Springs> springs(int /*row*/) const { return std::nullopt; }
  /// λ(x), that of least size where there are several. This and the next two are those of springs(); a law without must say itself.
  virtual Response respond(int row, double x) const;
  /// x(λ), of multipliers between the law's ends.
  virtual double displacement(int row, double lambda) const;
  /// Where λ(x) has a kink or several values, x ascending.
  virtual std::vector<double> kinks(int row) const;
  /// k where φ(x) = ½kx² for every x (infinite: x = 0); nothing where the law has branches.
  virtual std::optional<double> linear_stiffness(int /*row*/) const { return std::nullopt; }
};

/// Signorini: φ = 0 for x ≤ 0, ∞ beyond; λ ≥ 0, λx = 0. P(y) = y⁺.
std::shared_ptr<const Law> unilateral();

/// Glued or sliding: x = 0, any λ. P(y) = y.
std::shared_ptr<const Law> bilateral();

/// Newton's elastic support: φ = ½k x², λ = kx. P(y) = y k/(k + ρ).
/// `stiffness[row]` in force per displacement; throws InputError unless each is ≥ 0.
std::shared_ptr<const Law> elastic(std::vector<double> stiffness);

/// Generalised Newton's support, one spring where x < 0 and another where x > 0 (P4, remark 6, figure 15):
/// φ = ½k x², λ = kx, k by the side of x; P(y) = y k/(k + ρ), k by the side of y; φ*(λ) = λ²/2k. At y = 0, where P has a
/// kink, its slope is that of the stiffer side. A spring of 0 bears nothing on its side, the law is then one-sided.
/// `stiffness[row]` in force per displacement; throws InputError unless each is ≥ 0 and finite.
std::shared_ptr<const Law> unequal_elastic(std::vector<Springs> stiffness);

/// The force of a spring, cut off at two limits.
struct Limits {
  double stiffness = 0;  ///< k ≥ 0, force per displacement; infinite: rigid until a limit is reached
  double low = 0;        ///< ≤ 0, force; may be −∞
  double high = 0;       ///< ≥ 0, force; may be ∞
};

/// λ = kx where that lies between low and high, else the nearer of them (rigid: any λ between them at x = 0):
///   φ(x) = max over low ≤ λ ≤ high of λx − λ²/2k,   φ*(λ) = λ²/2k,   P(y) = y k/(k + ρ) cut off at low and high.
/// Of supports of beams (P4, figures 10 to 14) those with a branch of their own: one-sided elastic (0 and ∞), rigid
/// friction (k infinite, −g and g), one-sided rigid friction (k infinite, 0 and g), capped elastic (−g and g).
/// `name`: for messages. Throws InputError where a stiffness is negative or nan, low > 0 or high < 0.
std::shared_ptr<const Law> limited(std::string name, std::vector<Limits> limits);

/// Normal compliance, φ = c x⁺^(m+1)/(m+1), λ = c x⁺^m (Martins and Oden 1987; Kikuchi and Oden 1988, chapter 11): asperities that are pressed
/// flat. P(y) = y − ρx with x ≥ 0 from c x^m + ρx = y; φ*(λ) = m/(m+1) λ (λ/c)^(1/m). λ(x) is no line: Law::springs is absent.
/// `factors[row]`: c in force per displacement to the power m = `powers[row]`; throws InputError unless each is finite and ≥ 0, and m ≥ 1.
std::shared_ptr<const Law> power_law(std::vector<double> factors, std::vector<double> powers);

/// Is φ* known to be two parabolas, so that λ(x) has a kink at λ = 0?
bool kinked_at_zero(const Law& law, int row);

/// Where λ follows x (or x is held and λ free): at lesser x λ is the least multiplier, at greater x the greatest.
/// Of a law that tells its springs.
Interval following(const Law& law, int row);

}  // namespace dotyk::problem

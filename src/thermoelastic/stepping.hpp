#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "thermoelastic/system.hpp"

namespace dotyk::thermoelastic {

/// Of the schemes in time, both L-stable and stiffly accurate: the implicit Euler scheme; or TR-BDF2, half trapezoidal rule and
/// half backward differences in three stages, the first of them the end of the last step (Hosea and Shampine 1996): of stage
/// order 2, so that temperatures prescribed in time cost no order. Its first step is Alexander's (1977), of two stages and the
/// same γ = 1 − 1/√2. Every implicit stage is an Euler step of γτ.
enum class Order { one = 1, two = 2 };

struct Scheme {
  double step = 0;  ///< the longest, time
  Order order = Order::two;
  bool decompose = true;  ///< where statics does
  solver::Method method;  ///< of the interface problems; empty: PDAS
};

/// Energies of P4's equations with the weights kF/θ₀ and kJ/θ₀, since t = 0:
///   stored: ½∫ EF (Du₁)² + EJ (D²u₂)² + (c/θ₀)(F ϑ₁² + J ϑ₂²) and the supports',
///   put in: the loads' work, that of supports which are moved, and 1/θ₀ of the heat supplied times the temperature,
///   dissipated: conduction and exchange. stored + dissipated = put in + what was stored at first, to the scheme's order (but
///   where a prescribed temperature jumps from the one at first).
struct Energy {
  double stored = 0, put_in = 0, dissipated = 0;
  double released = 0;  ///< set free where supports broke, for a motion that this model does not follow; ≥ 0
  double defect = 0;    ///< stored + dissipated + released − put in − stored at first
};

/// A support's law that broke: "right deflection".
struct Broken {
  std::string name;
  double time = 0;
};

/// What a support does now.
struct Reaction {
  double force = 0, moment = 0, axial = 0;  ///< on the beam: up, anticlockwise, along x; loads given as laws and forces added included
  double deflection = 0, rotation = 0, displacement = 0;
  std::array<Driven, 3> driven{};  ///< by What
};

/// A thermoelastic beam stepped in time. Where α_h = α_d, stretching and bending are stepped on their own. A step within which
/// a support breaks is divided there, so that the scheme keeps its order. A call that throws leaves the state as it was.
class Stepping {
 public:
  /// At t = 0, at rest under the loads and temperatures of that time. Throws InputError as require_valid() and
  /// Interface::solve().
  Stepping(const Data& data, const Initial& initial, const Scheme& scheme, const Loads& loads, Monitor& monitor);
  Stepping(const Stepping&);
  Stepping& operator=(Stepping&&);
  ~Stepping();

  void step(const Loads& loads, Monitor& monitor) { advance(scheme_.step, loads, monitor); }
  /// To the time t ≥ time(), by equal steps none longer than the scheme's.
  void run(double t, const Loads& loads, Monitor& monitor);

  double time() const { return time_; }
  int steps() const { return steps_; }
  const Data& data() const;
  /// The effects, "bending" or "stretching", that were decomposed in every step since the last support broke.
  std::vector<std::string> decomposed() const;
  const Work& work() const { return work_; }
  Energy energy() const;
  const std::vector<Broken>& broken() const { return broken_; }  ///< in the order of time

  /// At x on the beam, else InputError.
  double deflection(double x) const;
  double rotation(double x) const;
  double displacement(double x) const;  ///< u₁
  double temperature(double x, double z = 0) const;
  double gradient(double x) const;
  double moment(double x) const;  ///< by equilibrium of the cell's ends, between them a cubic: exact for constant q
  double shear(double x) const;
  double normal(double x) const;  ///< N, a pull is positive; linear in the cells
  Reaction reaction(int support) const;

 private:
  struct Group;
  struct Stage;
  struct Place;
  void advance(double tau, const Loads& loads, Monitor& monitor);
  std::vector<Stage> trial(double tau, const Loads& loads, Work& work, Monitor& monitor);
  double overload(const std::vector<Stage>& ends) const;
  void accept(std::vector<Stage> ends, double tau, const Work& work);
  void break_within(double tau, const Loads& loads, Monitor& monitor);
  void break_supports(Group& group, Monitor& monitor);
  Stage stepped(Group& group, double tau, const Loads& loads, Work& work, Monitor& monitor);
  Fields solve(Group& group, const Forces& forces, const algebra::Vector& b, double t, double tau, bool displaced, Work& work,
               Monitor& monitor);
  Place place(Effect::Kind kind, double x) const;

  Scheme scheme_;
  std::vector<Group> groups_;
  double time_ = 0, at_first_ = 0;
  int steps_ = 0;
  Work work_;
  Energy energy_;  ///< put_in, dissipated and released
  std::vector<Broken> broken_;
};

}  // namespace dotyk::thermoelastic

#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "beam/element.hpp"
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
  /// What a stage is known by in the sums over a step.
  struct Rates {
    algebra::Vector entropy;              ///< its derivative by time
    double dissipated = 0, supplied = 0;  ///< power
  };

  /// Effects that are coupled.
  struct Group {
    void take(Model with, bool decompose);
    std::shared_ptr<const Model> model;
    std::vector<char> decomposed;           ///< of each part
    bool always_decomposed = true;          ///< since the model was taken
    std::shared_ptr<System> system, whole;  ///< as `decomposed` says; coupled, where statics did not do
    Fields now;
    Forces forces;
    algebra::Vector entropy;
    std::optional<Rates> rates;  ///< at the end of the last step

    double stored(const Fields& fields, const Forces& loads) const;
    double work_of_places(const Fields& to, const Forces& loads, bool trapezoidal) const;  ///< since `now`
    /// The greatest ratio of a breaking support's reaction to its limit.
    double overload(const std::vector<algebra::Vector>& reactions) const;
    /// Takes the breaking supports with this ratio out of the model; gives their names.
    std::vector<std::string> break_worst(bool decompose);
  };

  /// The end of a step, and what it put in and dissipated.
  struct Stage {
    Fields fields;
    Forces forces;
    algebra::Vector entropy;
    Rates rates;
    double put_in = 0, dissipated = 0;
  };

  struct Place {
    const Group& group;
    const Part& part;
    int cell;
    double s;                     ///< 0 ≤ s ≤ 1
    beam::Hermite shape() const;  ///< the cubic functions there
    CellVector u() const;         ///< the cell's unknowns
    Eigen::Vector4d theta() const;
    CellVector end_forces() const;  ///< on the cell, for its unknowns: the stress's less the load's
  };

  /// A breaking support bears so much of its limit; beyond it is not rounding.
  static constexpr double kBears = 1 + 1e-9;

  /// Runs it; an InputError tells which supports broke before, those from `first` on.
  void telling(std::size_t first, const std::function<void()>& run) const;
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

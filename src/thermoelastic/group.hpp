#pragma once
// What Stepping keeps of effects that are coupled; for its own sources.
#include "beam/element.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::thermoelastic {

/// What a stage is known by in the sums over a step.
struct Rates {
  algebra::Vector entropy;              ///< its derivative by time
  double dissipated = 0, supplied = 0;  ///< power
};

struct Stepping::Group {
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

/// Runs it; an InputError tells which supports broke before, those from `first` on.
void telling(const std::vector<Broken>& broken, std::size_t first, const std::function<void()>& run);

/// A breaking support bears so much of its limit; beyond it is not rounding.
constexpr double kBears = 1 + 1e-9;

/// The end of a step, and what it put in and dissipated.
struct Stepping::Stage {
  Fields fields;
  Forces forces;
  algebra::Vector entropy;
  Rates rates;
  double put_in = 0, dissipated = 0;
};

struct Stepping::Place {
  const Group& group;
  const Part& part;
  int cell;
  double s;                     ///< 0 ≤ s ≤ 1
  beam::Hermite shape() const;  ///< the cubic functions there
  CellVector u() const;         ///< the cell's unknowns
  Eigen::Vector4d theta() const;
  CellVector end_forces() const;  ///< on the cell, for its unknowns: the stress's less the load's
};

}  // namespace dotyk::thermoelastic

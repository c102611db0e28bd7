#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/monitor.hpp"
#include "solver/core/method.hpp"
#include "thermoelastic/data.hpp"
#include "thermoelastic/elements.hpp"

namespace dotyk::thermoelastic {

/// What a support's law is about.
enum class What { deflection, rotation, displacement };

/// A Drive's values at a time; `force` with a load given as law.
struct Driven {
  double place = 0, force = 0;
  bool operator==(const Driven&) const = default;
};
using SupportsDriven = std::vector<std::array<Driven, 3>>;  ///< in the order of Data::supports, by What

/// A support's law about v = turn·(w/unit − place), w one of the mechanical unknowns (a length); its force r on w is
/// turn·(the law's reaction)/unit.
struct Held {
  int support = 0;
  What what = What::deflection;
  std::string name;
  int unknown = 0;
  double unit = 1, turn = 1;
  problem::LawChoice law;
  double place(const SupportsDriven& driven) const { return driven[support][static_cast<int>(what)].place; }
  /// The row of the law is x = given − turn·w.
  double given(const SupportsDriven& driven) const;
};

/// An effect, its supports, and what its temperature weighs.
struct Part {
  Effect effect;
  int first = 0;           ///< of its unknowns among all u
  int first_heat = 0;      ///< of its temperature's among all ϑ
  double weight = 0;       ///< kF/θ₀ or kJ/θ₀
  std::vector<Held> held;  ///< unknowns among all u; without free and load
  algebra::DenseMatrix kernel;
};

/// Unknowns of ϑ whose values are prescribed.
struct HeldTemperature {
  int unknown = 0;
  int part = 0;
  int end = 0;
};

/// Loads at a time.
struct Forces {
  algebra::Vector f;                           ///< on u
  algebra::Vector r;                           ///< on ϑ, weighted
  algebra::Vector held_heat;                   ///< values, in the order of Model::held_heat
  std::vector<algebra::DenseMatrix> on_cells;  ///< f's distributed part cell by cell, of each part
  SupportsDriven supports;                     ///< their forces are in f
};

/// The effects that are coupled with each other, discretised in space. With the weights the coupling is skew:
///   K u + G ϑ = f + reactions,   d/dt (C ϑ − Gᵀu) + L ϑ = r.
struct Model {
  /// Both effects, or one: `effects`.
  Model(const Data& data, const std::vector<Effect::Kind>& effects);
  Forces forces(const Loads& loads, double t) const;
  /// ϑ₁, ϑ₂ at t = 0 by least squares.
  algebra::Vector initial(const Initial& initial) const;
  algebra::Vector entropy(const algebra::Vector& u, const algebra::Vector& theta) const {
    return capacity * theta - G.transpose() * u;
  }

  Data data;
  Coefficients coefficients;
  HeatElements heat;
  std::vector<Part> parts;
  std::vector<HeldTemperature> held_heat;
  algebra::SparseMatrix K, G, capacity, conduction;  ///< symmetric ones in full

 private:
  void add_part(Effect::Kind kind, const std::vector<double>& nodes);
  void add_matrices();
  SupportsDriven driven(const Loads& loads, double t) const;
  Source heat_source(const Part& part, const Loads& loads, double t) const;
  std::vector<algebra::DenseMatrix> unit_loads_;  ///< of a transverse or axial load 1
  algebra::Vector unit_heat_;                     ///< ∫ η
};

/// What of a method's runs is worth telling.
struct Work {
  std::string method, reason;  ///< of the last problem
  int problems = 0, iterations = 0;
};

/// The problem of a step on the unknowns at the supports and ends alone, w: minimise ½wᵀSw − gᵀw + the supports' energies.
/// S is the same in every step. Its kernel consists of the motions without strain.
class Interface {
 public:
  /// `parts`: those whose supports it is about; `gamma`: their unknowns w among all u; S: on these.
  Interface(const Model& model, std::vector<int> parts, const std::vector<int>& gamma, const algebra::DenseMatrix& S);

  /// w, for g, the load's resultants Rᵀf on the motions of the parts one after the other, and the supports' places; and into `reactions` the forces of
  /// the supports on it, part by part as Part::held. Throws InputError where there is no solution, naming the motion that nothing
  /// stops, or where the method did not converge.
  algebra::Vector solve(algebra::Vector g, const algebra::Vector& resultants, const SupportsDriven& driven, double t,
                        const solver::Method& method, std::vector<algebra::Vector>& reactions, Work& work, Monitor& monitor);

 private:
  void require_solvable(double t);

  const Model& model_;
  std::vector<int> parts_;
  problem::Problem problem_;
  std::shared_ptr<problem::Condenser> condenser_ = std::make_shared<problem::Condenser>();
  algebra::Vector solvable_;  ///< resultants of the load that was last found to have a solution
};

}  // namespace dotyk::thermoelastic

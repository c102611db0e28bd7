#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elasticity/stress.hpp"
#include "problem/residual.hpp"
#include "scene/model.hpp"
#include "scene/scene.hpp"
#include "solver/method.hpp"

namespace dotyk::scene {

/// One contact node after the solve; at a corner there is one for each adjoining side.
struct ContactNode {
  int node = 0;                ///< of the first body's mesh
  mesh::Point x{};             ///< at rest
  mesh::Point displacement{};
  mesh::Point normal{};        ///< unit, out of the first body
  double gap = 0;              ///< after deformation, positive when open
  double force = 0;            ///< normal multiplier, positive in compression
  double pressure = 0;         ///< force / weight
  double weight = 0;           ///< length or area of the node
  mesh::Point shear{};         ///< per length or area, on the first body
  mesh::Point slip{};          ///< tangential jump
  problem::Status status = problem::Status::open;
};

struct ContactResult {
  mesh::Point force{};         ///< on the first part
  double area = 0;             ///< of closed nodes
  double max_pressure = 0;
  int open = 0, closed = 0, stick = 0, slip = 0;
  std::vector<ContactNode> nodes;
};

class Locator;

/// What a solve gives: the state of every body and contact, how it ended, and how far to trust it.
class Solution {
 public:
  /// `scene` as the model was built from it: nothing may be added to it any more.
  Solution(std::shared_ptr<const Scene> scene, Model model, solver::Result result);
  ~Solution();

  /// The scene as it was solved: contacts added since are not in it. Its bodies are the ones the script
  /// holds; what these bore then is body().
  const Scene& scene() const { return *scene_; }
  /// A body with the supports and loads it had when it was solved.
  const Body& body(int index) const { return model_.bodies[index]; }
  const solver::Result& result() const { return result_; }
  const problem::Residual& residual() const { return residual_; }
  const problem::Clock& clock() const { return result_.clock; }
  void set_total(double seconds) { result_.clock.total = seconds; }
  double energy() const { return energy_; }
  double friction_energy() const { return friction_energy_; }
  int unknowns() const { return static_cast<int>(result_.state.u.size()); }
  int rows() const { return static_cast<int>(result_.state.lambda.size()); }

  /// Nodal displacement of a body (index in the scene), node × dimension.
  const std::vector<double>& displacement(int body) const { return displacement_[body]; }
  /// Recovered nodal stress, computed on first use (its time is added to the clock's recover and total).
  const std::vector<elasticity::Stress>& stress(int body) const;

  /// At a point at rest. Throws InputError outside the body.
  mesh::Point displacement(int body, const mesh::Point& x) const;
  elasticity::Stress stress(int body, const mesh::Point& x) const;

  /// Throws InputError for a contact that is not of the scene as it was solved.
  ContactResult contact(const Contact& contact) const;
  /// Force that the supports (fix, slide, displace, spring) of the part exert on the body. A node
  /// component held by several parts counts for the one that held it first.
  mesh::Point reaction(const Part& part) const;
  /// Recovery estimate of the relative error in the energy norm.
  double error_estimate() const;

  /// Rows flagged active, contact by contact, for starting another solve.
  const Model& model() const { return model_; }
  bool active(int row) const;

 private:
  const Locator& locator(int body) const;

  std::shared_ptr<const Scene> scene_;
  Model model_;
  mutable solver::Result result_;
  problem::Residual residual_;
  double energy_ = 0, friction_energy_ = 0;
  std::vector<std::vector<double>> displacement_;
  mutable std::vector<std::vector<elasticity::Stress>> stress_;
  mutable std::vector<std::unique_ptr<Locator>> locators_;
};

/// Where contacts start: as a coarser solution's nearest nodes were, or with the rows named
/// (numbered over all contacts in order); empty: by the method's own rule.
struct Start {
  std::shared_ptr<const Solution> coarse;
  std::optional<std::vector<int>> closed;
};

/// Assembles and solves. No method named: PDAS, or Newton where there is friction.
std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start,
                                Monitor& monitor);

/// The flags of a start, row by row of B; empty where `start` says nothing.
std::vector<char> start_flags(const Scene& scene, const Model& model, const Start& start);

/// Contact nodes of all contacts as comma-separated values with a header line. The file appears
/// whole or not at all. Throws InputError where it cannot be written.
void write_contact(const Solution& solution, const std::string& file);

/// A short report.
std::string describe(const Solution& solution);

}  // namespace dotyk::scene

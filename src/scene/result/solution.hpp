#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elasticity/error_estimate.hpp"
#include "elasticity/stress.hpp"
#include "problem/residual.hpp"
#include "scene/model/model.hpp"
#include "scene/result/locate.hpp"
#include "scene/statement/scene.hpp"
#include "solver/core/method.hpp"

namespace dotyk::scene {

/// One contact node after the solve; at a corner there is one for each adjoining side.
struct ContactNode {
  int node = 0;                ///< of the first body's mesh
  mesh::Point x{};             ///< at rest; beside an edge of the second part, where the row is a mean over nodes (contact/pairing.hpp), where its force acts
  mesh::Point displacement{};
  mesh::Point normal{};        ///< unit, out of the first body
  double gap = 0;              ///< after deformation, positive when open
  double force = 0;            ///< normal multiplier, positive in compression
  double pressure = 0;         ///< force / weight, a mean over the node's surroundings
  mesh::Point centre{};        ///< the place where pressure and shear are such, but for terms of second order: at an end of the part off the node
  double weight = 0;           ///< length or area of the node
  mesh::Point shear{};         ///< per length or area, on the first body
  mesh::Point slip{};          ///< tangential jump since the beginning, less a rigid shape's displacement
  problem::Status status = problem::Status::open;
};

/// What the nodes of a contact, or of a support by laws, do along the normal.
struct NodeCount {
  double area = 0;          ///< where it presses: of a contact the edge is sought between nodes, of a support the shares of nodes that are not open
  double max_pressure = 0;
  int open = 0, closed = 0, stick = 0, slip = 0;  ///< nodes, by their status
  void add(problem::Status status, double weight, double pressure);
};

struct ContactResult : NodeCount {
  mesh::Point force{};           ///< on the first part
  mesh::Point friction_force{};  ///< its part by friction
  /// Work that friction has dissipated, over all steps: Σ λ_t·(increment of slip), each term ≥ 0.
  double dissipated = 0;
  std::vector<ContactNode> nodes;
};

/// The result as to the parts in the order they were given: of a contact that is turned, forces, normals, shear and slip change sign;
/// its nodes are still those of the part with the multipliers.
ContactResult as_given(const Contact& contact, ContactResult result);

/// One node of a support by laws after the solve; at a corner there is one for each adjoining side. Signs as in LawSupport.
struct SupportNode {
  int node = 0;                ///< of the body's mesh
  mesh::Point x{};             ///< at rest
  mesh::Point normal{};        ///< unit, outward
  double weight = 0;           ///< length or area of the node
  double away = 0;             ///< v along the normal, positive away from the support
  double pressure = 0;         ///< r along the normal per length or area, positive where it pushes
  mesh::Point slip{};          ///< tangential displacement
  mesh::Point shear{};         ///< tangential reaction on the body per length or area
  /// Along the normal: open where it bears nothing, closed where it holds or springs back, slip where it
  /// bears what its law gives at most; a rigid or capped one that does not sticks.
  problem::Status status = problem::Status::open;
  problem::Status tangential = problem::Status::open;  ///< the same of its tangents
  bool broken = false;
};

struct SupportResult : NodeCount {
  mesh::Point force{};  ///< on the body
  int broken = 0;       ///< nodes
  int tangential_stick = 0, tangential_slip = 0;
  double dissipated = 0;  ///< as of a contact
  std::vector<SupportNode> nodes;
};

/// Of the energy norm (energy_norm.hpp) of u − u_h, all bodies together; see elasticity/error_estimate.hpp for the parts. A
/// spring is taken as a load that its displacement says, which is admissible: the bound there is then one of this norm.
struct ErrorEstimate {
  double absolute = 0;  ///< √Σ of the parts: √(force·length)
  double relative = 0;  ///< absolute / √(absolute² + ‖u_h‖²)
  elasticity::ErrorParts parts;                              ///< squares
  std::vector<std::vector<elasticity::ErrorParts>> cells;    ///< body → cell → its share; where ranks refine the bodies, of cells here, right at the boundary alone
};

class Solution;
struct InnerValues;

/// What a solution follows in a quasi-static history.
struct Past {
  Loading loading;                 ///< of the solution itself
  algebra::Vector slip;            ///< on the rows of friction, up to the last step; empty at the beginning
  std::vector<double> dissipated;  ///< likewise, the work of friction
  std::vector<std::shared_ptr<const Solution>> steps;  ///< the steps before in the same call of solve
};

/// What a solve gives: the state of every body and contact, how it ended, and how far to trust it.
class Solution : public std::enable_shared_from_this<Solution> {
 public:
  /// `scene` as the model was built from it: nothing may be added to it any more. `with_stiffness`: the
  /// problem where `model` lacks the stiffness matrices, else null.
  Solution(std::shared_ptr<const Scene> scene, Model model, const problem::Problem* with_stiffness,
           solver::Result result, Past past);

  /// The scene as it was solved: contacts added since are not in it. Its bodies are the ones the script
  /// holds; what these bore then is body().
  const Scene& scene() const { return *scene_; }
  /// A body with the supports and loads it had when it was solved.
  const Body& body(int index) const { return model_.bodies[index]; }
  const solver::Result& result() const { return result_; }
  const problem::Residual& residual() const { return residual_; }
  const problem::Clock& clock() const { return result_.clock; }
  void set_total(double seconds) { result_.clock.total = seconds; }
  /// The same with another displacement that obeys the laws under the same forces.
  std::shared_ptr<Solution> with(algebra::Vector u) const;
  /// Does it follow another in a history?
  bool follows() const { return !past_.steps.empty() || past_.slip.size() > 0; }
  /// "; one load step" after the reason.
  void add_reason(const std::string& more) { result_.reason += more; }
  /// "step 3 of 10: " before the reason.
  void name_step(const std::string& step) { result_.reason = step + result_.reason; }
  double energy() const { return residual_.energy; }
  /// Σ bound ‖increment of slip‖: what friction dissipates in this step.
  double friction_energy() const { return friction_energy_; }
  const Loading& loading() const { return past_.loading; }
  /// On the rows of friction, of contacts and supports (0 on others): slip since the beginning, and what it has dissipated.
  const algebra::Vector& slip() const { return slip_; }
  const std::vector<double>& dissipated() const { return dissipated_; }
  /// The steps of the solve, this one the last.
  std::vector<std::shared_ptr<const Solution>> steps() const;
  int unknowns() const { return static_cast<int>(result_.state.u.size()); }
  int rows() const { return static_cast<int>(result_.state.lambda.size()); }

  /// Nodal displacement of a body (index in the scene), node × dimension; made on first use.
  const std::vector<double>& displacement(int body) const;
  /// Recovered nodal stress, computed on first use (its time is added to the clock's recover and total).
  const std::vector<elasticity::Stress>& stress(int body) const;

  /// At a point at rest. Throws InputError outside the body.
  mesh::Point displacement(int body, const mesh::Point& x) const;
  elasticity::Stress stress(int body, const mesh::Point& x) const;

  /// Here and below a body, contact or part may be another design's. Throws InputError for a contact that is not of the scene as it
  /// was solved.
  ContactResult contact(const Contact& contact) const;
  /// A part's support by laws, per node. Throws InputError where it has none, naming the parts that have.
  SupportResult support(const Part& part) const;
  /// Force that the supports (fix, slide, displace, spring, laws) of the part exert on the body. A node
  /// component held by several parts counts for the one that held it first.
  mesh::Point reaction(const Part& part) const;
  /// How far one load step is from kPathSteps equal ones of the load, the prescribed displacements and the rigid shapes' displacements:
  /// Σ|λ_t − λ_t'| over the points of friction in Σ|λ_t'|, λ_t' their forces after the steps. A node that sticks where a share τ of the load
  /// has closed it bears 1/(1 − τ) times too much after one step; by two steps that is not seen if τ < ½, by n if τ < 1/n. Of a solution
  /// without steps before it; the steps have one factorisation and the default method. 0 where a part of the load has that part of the
  /// solution: no gap closed, friction is Coulomb's and laws are cones. Throws InputError for a solution that follows another, or where the steps do not converge. Made on first use.
  double path_error(Monitor& monitor) const;
  static constexpr int kPathSteps = 8;
  /// A posteriori estimate of the error in the energy norm, contact included, made on first use.
  const ErrorEstimate& error_estimate() const;

  /// As the scene was solved; a step that is not the last has no stiffness matrices.
  const Model& model() const { return model_; }
  bool active(int row) const;
  /// See problem::rounding_of_forces(); made on first use.
  const algebra::Vector& rounding_of_forces() const;
  const problem::Measure& measure() const;  ///< of its state

 private:
  ErrorEstimate make_error_estimate() const;
  SupportNode support_node(const LawSupport& support, std::size_t node, const SupportRows& rows, int body) const;
  Solution(const Solution& other, algebra::Vector u);
  void take_state(const problem::Problem& problem);
  std::optional<Place> place(int body, const mesh::Point& x) const;
  InnerValues inside(int body, const mesh::Point& x) const;  ///< where the ranks have the cell; throws outside

  std::shared_ptr<const Scene> scene_;
  Model model_;
  mutable solver::Result result_;
  problem::Residual residual_;
  double friction_energy_ = 0;
  Past past_;
  algebra::Vector slip_;
  std::vector<double> dissipated_;
  mutable std::vector<std::vector<double>> displacement_;
  mutable std::vector<std::vector<elasticity::Stress>> stress_;
  mutable std::vector<std::optional<Locator>> locators_;
  mutable std::optional<ErrorEstimate> error_estimate_;
  mutable std::optional<double> path_error_;
  mutable std::optional<algebra::Vector> rounding_of_forces_;
  mutable std::optional<problem::Measure> measure_;
};

/// A motion of a whole body: x moves by translation + rotation × (x − about).
struct RigidMotion {
  mesh::Point translation{}, rotation{}, about{};
};

/// The same solution with one body moved rigidly. Where a solution is unique up to a rigid motion, all these are solutions, with the same forces and energy. A
/// solve gives the one of least displacement; TR965 chooses the one with p(v) = 0, (1.77)–(1.78). Throws InputError where supports resist the motion, where
/// contacts or laws do not allow it, and for a step that is not the last of its history.
std::shared_ptr<Solution> moved_rigidly(const Solution& solution, int body, const RigidMotion& motion);

/// Does friction depend on the way of the load? Where something rubs and a contact, this one or another, closed from a gap on the way (or opened
/// from a pressure fit): a single step takes all of the jump since rest for slip, also what came before the node closed.
bool follows_path(const Solution& solution);

/// Where contacts and supports by laws start: as a coarser solution's nearest nodes were (its contact or support of the
/// same number), or with the contact rows named (numbered over all contacts in order); rows of which neither tells, and
/// all where both are empty: closed where their gap at rest is, or as `after` ended. A solution with the
/// same rows gives methods that can its whole state.
struct Start {
  std::shared_ptr<const Solution> coarse;
  std::optional<std::vector<int>> closed;
  /// The solution that this one follows: slip is measured from it, and its loading goes on.
  std::shared_ptr<const Solution> after = nullptr;
  /// Where methods that condense leave what they factored, for other solves with the same K and B (see
  /// shape::Sensitivity); empty: their own.
  std::shared_ptr<problem::Condenser> condenser = nullptr;
};

/// Assembles and solves. No method named: PDAS, or Newton where there is friction.
///
/// With `steps`, quasi-statically one after the other: in step k the friction force opposes the increment
/// of slip, λ_t ∈ ∂(b‖·‖)((Bu_k)_t − (Bu_{k−1})_t) (the rows' gap is the slip of the last step), so friction
/// remembers. The steps have one K and one B, condensed once; each starts from the contacts of the last.
/// The result is the last step; a step that does not converge is the last. Throws InputError with the
/// step's number where a step has no solution, and where the rows of `after` are not those of the scene.
std::shared_ptr<Solution> solve(std::shared_ptr<const Scene> scene, const solver::Method& method, const Start& start,
                                Monitor& monitor, const std::vector<Step>& steps = {});

/// Every solution of a scene in the plane with few contact nodes, by enumeration (solver/pieces/enumeration.hpp): with
/// Coulomb friction of a great coefficient there may be several, a continuum of them, or none.
struct AllSolutions {
  struct Family {
    int dimension;
    std::vector<int> ends;  ///< places in `solutions`
    bool unbounded, forces_only;
    int continuum;  ///< which connected set it is a part of, from 0
  };
  std::vector<std::shared_ptr<Solution>> solutions;  ///< the isolated ones, then the ends of families
  std::vector<Family> families;
  std::string summary;
};
AllSolutions all_solutions(std::shared_ptr<const Scene> scene, Monitor& monitor);

/// The flags of a start, row by row of B: is the row on the branch of its law that bears?
std::vector<char> start_flags(const Scene& scene, const Model& model, const Start& start);

/// Has the solution the unknowns and rows of this scene's model: bodies with the same meshes, the same contacts of the same nodes?
bool same_rows(const Scene& scene, const Model& model, const Solution& solution);

/// Contact nodes of all contacts as comma-separated values with a header line: contact, node, x y (z), gap,
/// pressure, force, weight, the components of shear and of slip, status. The file appears
/// whole or not at all. Throws InputError where it cannot be written.
void write_contact(const Solution& solution, const std::string& file);

/// "force (0, 6), 9 closed, 0 open, tangents 7 stick, 2 slip, greatest pressure 4.6".
std::string describe(const SupportResult& result, int dimension);
/// A short report.
std::string describe(const Solution& solution);

}  // namespace dotyk::scene

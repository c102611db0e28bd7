#pragma once

#include <span>
#include <vector>

#include "problem/rows.hpp"
#include "scene/model/free_jumps.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// What nodes and their partners give to a row: direction·(Σ weight u_own − Σ weight u_partner), a weight in the direction's length.
struct Pull {
  std::span<const contact::NodeWeight> own;       ///< not kept
  std::span<const contact::NodeWeight> partners;  ///< not kept
  mesh::Point direction;
};

/// Rows of a scene's problem by nodes and directions. Used while a model is built.
class RowBuilder {
 public:
  RowBuilder(const Scene& scene, Model& model) : rows(model.problem), scene_(scene), model_(model) {}

  /// The rigid shape of rows added from now on is displaced by this: part of their gap.
  void set_move(const mesh::Point& move) { move_ = move; }
  /// The row Σ pulls (at least one) = gap, of two bodies or of one and a rigid shape (other_body -1); returns it, or -1 where nothing
  /// is unknown. `gap` is reduced by what prescribed components contribute and left so. `share`, `own`: see problem::Rows.
  int add(int body, int other_body, const std::vector<Pull>& pulls, double& gap, double share = 1, const problem::LawChoice* own = nullptr);
  /// The row direction·Σ weight u.
  int add(int body, const std::vector<contact::NodeWeight>& mean, const mesh::Point& direction, double& gap, double share = 1, const problem::LawChoice* own = nullptr);

  /// Rows of springs, at the place of the first node that each moves.
  void add(int body, const elasticity::SpringRows& springs);

  /// Sets B, c and the rows' names.
  void finish();

  problem::Rows rows;

 private:
  void collect(int body, int node, const mesh::Point& direction, double sign, double& gap);

  struct Place {
    int body, node;
  };
  const Scene& scene_;
  Model& model_;
  mesh::Point move_{0, 0, 0};
  std::vector<Place> places_;  ///< where a row is, for messages made only when needed
};

/// Adds the rows of the newest contact of the model, one of Model::contacts. Normal ones: none where supports hold the normal on both
/// sides. Tangential ones: springs, a row for each free tangent of a node; for each cell of friction with an unknown along its tangents, a
/// node's surroundings where multipliers are nodal. No rows where the bound or coefficient is 0; rows that never slip where it is
/// infinite. The normal row of a friction point is its node's; of a cell (given friction only, whose bound does
/// not depend on it) that of the node with most weight in it. Throws InputError where nodes fixed on both sides lie inside each other.
void add_contact_rows(const Scene& scene, const Contact& contact, const FreeJumps& jumps, RowBuilder& builder, Model& model);

/// Adds the rows of a body's support laws and notes them in the model (for all bodies, one after the other). Normal
/// rows measure u·n, tangential ones u·t, so that the reaction on the body is −λ along the row's direction; a node has no row in
/// a direction that other supports hold. Friction is given friction (Tresca), bound times share. Throws InputError where a
/// node that is held cannot obey a law: a prescribed displacement of another value, Signorini's below 0.
void add_support_rows(int body, RowBuilder& builder, Model& model);

/// The force of `load` laws on the body at a node.
mesh::Point law_load(const LawSupport& support, std::size_t node, int dimension);
/// Adds the forces of the body's `load` laws to its nodal loads.
void add_law_loads(Body& body);

/// The energy ½g²/k (times share) that each broken support took.
double broken_energy(const Body& body);

}  // namespace dotyk::scene

#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "problem/rows.hpp"
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
  /// is unknown. `gap` is reduced by what prescribed components contribute and left so. `share`: see problem::Rows.
  int add(int body, int other_body, const std::vector<Pull>& pulls, double& gap, double share = 1);
  /// The row direction·Σ weight u.
  int add(int body, const std::vector<contact::NodeWeight>& mean, const mesh::Point& direction, double& gap, double share = 1);

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

}  // namespace dotyk::scene

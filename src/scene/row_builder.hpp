#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/model.hpp"

namespace dotyk::scene {

/// Gathers rows of B as they come. Used while a model is built.
class RowBuilder {
 public:
  RowBuilder(const Scene& scene, Model& model) : scene_(scene), model_(model) {}

  /// Rows added from now on are under this law.
  void open_group(const std::string& name, std::shared_ptr<const problem::Law> law);
  /// Rows added from now on are tangential, under a law set later; returns the next row.
  int open_friction();

  /// Σ ± direction·u at one or two nodes = jump; returns the row, or -1 where nothing is unknown.
  /// `gap` is reduced by what prescribed components contribute and left so.
  int add(int body, int node, int other_body, int other_node, const mesh::Point& direction, double& gap);

  /// Sets B, c and the rows' names.
  void finish();

 private:
  void collect(int body, int node, const mesh::Point& direction, double sign, double& gap);

  struct Place {
    int body, node;
  };
  const Scene& scene_;
  Model& model_;
  bool scalar_ = true;  ///< rows belong to the last scalar group
  int count_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> gaps_;
  std::vector<Place> places_;  ///< where a row is, for messages made only when needed
};

/// Adds the tangential rows of a contact with friction: for each row of the contact with an unknown
/// along its normal. No rows where the bound or coefficient is 0; rows that never slip where it is
/// infinite.
void add_friction_rows(const Scene& scene, const Contact& contact, RowBuilder& builder, Model& model);

}  // namespace dotyk::scene

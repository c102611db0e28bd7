#pragma once

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// What is known of the tractions on a body's boundary, facet by facet: loads and springs; where all nodes of a facet are held
/// in a direction, nothing of it.
class Boundary {
 public:
  Boundary(const Body& body, const elasticity::Numbering& numbering, const std::vector<double>& u);

  /// Null where the facet is not on the boundary.
  elasticity::FacetTraction* find(mesh::Facet f);
  const std::vector<elasticity::FacetTraction>& all() const { return all_; }

 private:
  void add_spring(const elasticity::FacetSpring& spring, const std::vector<double>& u);
  void forget_held(const Body& body, const elasticity::Numbering& numbering);
  int corners() const { return mesh_.topology().nodes_per_facet; }

  const mesh::Mesh& mesh_;
  std::vector<elasticity::FacetTraction> all_;  ///< by facet
};

/// Adds the tractions of a contact to the first body's facets.
void add_first(const contact::Surface& surface, const ContactResult& result, Boundary& boundary);
/// Adds the opposite ones to the second body's.
void add_second(const Contact& contact, const ContactResult& result, Boundary& boundary);

}  // namespace dotyk::scene

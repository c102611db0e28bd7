#include "shape/derivative/contact_derivative.hpp"

#include "shape/derivative/row_changes.hpp"

namespace dotyk::shape {
std::vector<ContactValue> contact_values(const scene::Solution& solution, int index) {
  std::vector<ContactValue> values;
  for (const scene::ContactNode& node : solution.contact(*solution.scene().contacts[static_cast<std::size_t>(index)]).nodes) values.push_back({node.force, node.gap, node.weight});
  return values;
}

std::vector<ContactValue> contact_derivatives(const scene::Solution& solution, int index, const Velocities& V, const Derivative& derivative) {
  const std::vector<double> weights = weight_changes(solution, index, V);
  const std::vector<int>& row = solution.model().contact_row[static_cast<std::size_t>(index)];
  std::vector<ContactValue> derivatives(weights.size());
  for (std::size_t k = 0; k < weights.size(); ++k) {
    derivatives[k].weight = weights[k];
    if (row[k] < 0) continue;
    derivatives[k].force = derivative.lambda[row[k]];
    derivatives[k].gap = -derivative.x[row[k]];
  }
  return derivatives;
}

}  // namespace dotyk::shape

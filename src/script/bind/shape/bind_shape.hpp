#pragma once
// What scripts hold of shape optimisation.
#include <memory>
#include <string>
#include <vector>

#include "scene/result/locate.hpp"
#include "script/bridge/call.hpp"
#include "algebra/types.hpp"
#include "script/bridge/wrapped.hpp"
#include "shape/design/evaluator.hpp"

namespace dotyk::script {

class Library;

// A dual number of a script (lua/dual.lua): a value and its gradient.
struct Dual {
  double value = 0;
  algebra::Vector gradient;
};

void push(lua_State* L, const Dual& dual);

// The dual number on top of the stack, which is taken off; where `size` is 0, also a number. Throws std::runtime_error,
// beginning with `what`, for anything else, another size, and numbers that are not finite.
Dual take_dual(lua_State* L, Eigen::Index size, const std::string& what);

// Finds the cells of the first design.
class Places {
 public:
  explicit Places(const scene::Scene& scene) : scene_(scene), locators_(scene.bodies.size()) {}
  // Throws InputError outside the body.
  scene::Place find(int body, const mesh::Point& x);

 private:
  const scene::Scene& scene_;
  std::vector<std::unique_ptr<scene::Locator>> locators_;
};

// What is minimised or kept below a bound: one of the quantities, or a function kept with the object under this name.
struct QuantityChoice {
  std::string kept;  // empty: not a function
  std::shared_ptr<const shape::Quantity> quantity;
  std::string name() const { return quantity ? quantity->name() : "function"; }
};

// A scene, its design variables, what is sought and how.
struct Shape {
  std::shared_ptr<const shape::DesignSpace> space;
  std::shared_ptr<Places> places;
  algebra::Vector lower, upper, start;
  QuantityChoice objective;
  std::vector<QuantityChoice> constraints;
  std::vector<double> most;  // of each constraint
  double exponent = 8, step = 0;
  solver::Method method;
};

// A design as a script sees it; its numbers are duals unless derivatives are not wanted.
struct Design {
  std::shared_ptr<const shape::DesignState> state;
  std::shared_ptr<Places> places;
  double exponent;  // of peak_pressure
  bool derivatives = true;
  Design(std::shared_ptr<const shape::DesignState> of, const Shape& shape) : state(std::move(of)), places(shape.places), exponent(shape.exponent) {}
  Dual dual(const shape::Quantity& quantity) const;
};

template <> struct Wrapped<Design> : Called<"design"> {};
template <> struct Wrapped<Shape> : Called<"shape"> {};

// As many numbers as there are design variables; throws InputError, which calls them `what`, where there are more or fewer.
algebra::Vector variables_of(const std::vector<double>& values, const shape::DesignSpace& space, const char* what);

// The objective and the constraints, functions taken from those kept with the shape at stack index 1, for the running call.
struct Sought {
  std::shared_ptr<const shape::Quantity> objective;
  std::vector<shape::DesignConstraint> constraints;
};
Sought sought(const Call& call, const Shape& shape);

void bind_design(Library& library);
void bind_optimum(Library& library);

}  // namespace dotyk::script

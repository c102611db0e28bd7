#pragma once
// The words that the objects of scripts go by, and what a script holds where
// that is not a class of the numerical rooms itself.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/rigid.hpp"
#include "elasticity/material.hpp"
#include "mesh/mesh.hpp"
#include "scene/statement/scene.hpp"
#include "scene/result/solution.hpp"
#include "script/bridge/push.hpp"

namespace dotyk::script {

// Values of a material: E and nu, which are taken from functions kept with the object where these vary in space; or a stiffness.
struct Material {
  std::optional<double> E, nu;
  elasticity::Plane plane = elasticity::Plane::strain;
  std::optional<elasticity::Hooke> stiffness;
  std::optional<double> density;
};

// Moving the nodes of a mesh that a body uses makes the handle's own copy.
struct MeshHandle {
  std::shared_ptr<mesh::Mesh> mesh;
  std::vector<std::string> regions = {}, notes = {};  // of one from a file, see meshfile::Loaded
};

// A rigid shape. A gap without a value has a function, kept with the object.
struct Rigid {
  contact::RigidShape shape;
  int dimension;
};

// A method with its options; on_iteration is kept with the object.
struct Solver {
  solver::Method method;
  std::string own;     // name and its own options, as printed
  double tol = 0;
  std::string common;  // ", max_iterations = 100" and what else every method takes
  bool verbose = false;
  std::string text() const;
};

template <> struct Wrapped<Material> : Called<"material"> {};
template <> struct Wrapped<MeshHandle> : Called<"mesh"> {};
template <> struct Wrapped<scene::Body> : Called<"body"> {};
template <> struct Wrapped<scene::Part> : Called<"part"> {};
template <> struct Wrapped<scene::Scene> : Called<"scene"> {};
template <> struct Wrapped<scene::Contact> : Called<"contact"> {};
template <> struct Wrapped<Rigid> : Called<"rigid"> {};
template <> struct Wrapped<Solver> : Called<"solver"> {};
template <> struct Wrapped<scene::Solution> : Called<"solution"> {};

}  // namespace dotyk::script

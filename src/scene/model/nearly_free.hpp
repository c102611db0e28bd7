#pragma once

#include "elasticity/weak_motions.hpp"
#include "scene/model/model.hpp"

namespace dotyk::scene {

/// "fix of left (2 nodes), spring on top": what holds a body.
std::string supports_of(const Body& body);

/// elasticity::weak_motions() of the b-th body; where ranks refine it, of its mesh before that.
elasticity::WeakMotions weak_motions(const Model& model, std::size_t b);

}  // namespace dotyk::scene

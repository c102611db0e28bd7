#pragma once

#include <string>

#include "scene/model/model.hpp"

namespace dotyk::scene {

/// Supports that break are not monotone, and the energy has many local minima; on a part with n nodes 2ⁿ choices of
/// broken ones would have to be tried. A scene follows one path instead, a cascade: all whole, the convex problem is
/// solved; the nodes that exceed their limit most, relative to it, break (ties together); and so on until none
/// exceeds it. What is broken stays so, over the steps of a history as well. Where at the end each broken node is
/// displaced by more than what breaks it, the state is a local minimum of the energy; there may be others, lower ones.

/// Does any law of these bodies break?
bool may_break(const std::vector<Body>& bodies);
/// Breaks the worst nodes of a solution λ of `model` in `bodies`; how many, 0 where all bear what they must.
int break_worst(const Model& model, const algebra::Vector& lambda, std::vector<Body>& bodies);
/// Takes over which nodes are broken; bodies without counterpart stay.
void take_broken(const std::vector<Body>& from, std::vector<Body>& to);
/// What the cascade did, for the solution's reason; empty where nothing is broken.
std::string cascade_note(const Model& model, const algebra::Vector& u, int rounds);

}  // namespace dotyk::scene

#pragma once

#include <vector>

namespace dotyk::shape {

/// How the nodes of a scene's bodies move: body → node × dimension, length per unit of the design variable; empty: the
/// body rests.
using Velocities = std::vector<std::vector<double>>;

}  // namespace dotyk::shape

#pragma once

#include <optional>
#include <string>

#include "plate/model.hpp"

namespace dotyk::plate {

/// What is known before solving: whether reactions that the supports can give balance the load.
struct Verdict {
  std::string note;   ///< that the solution is unique up to a motion, a limit case, and by which condition; empty where it is unique
  std::optional<algebra::Vector> motion;  ///< of all freedoms, greatest 1: the solution is known but for this
};

/// Throws InputError where there is no solution: with the motion that nothing stops, the work of the load on it, and the condition of P5.
Verdict require_solvable(const Model& model);

/// The conditions of P5 that are about these supports: (33) of the free plate, (44) to (46) of Signorini's edge, (62) to (64) of
/// friction, (73) and (74) of the one-sided elastic edge.
std::string conditions(const Model& model);

}  // namespace dotyk::plate

#pragma once

#include <optional>

#include "thermoelastic/model.hpp"

namespace dotyk::thermoelastic {

/// Do the laws of this part's supports have reactions that statics alone gives? Then its stress does not depend on its
/// temperature, and the heat equation can be solved without the displacement: the decomposition of P4. So it is in the six
/// exceptional cases (simply supported, cantilever, simply supported and guided, rigid or elastic), and wherever a
/// condition of solvability forces one of them (theorems 2 to 5): with as many laws as motions that these notice.
bool determinate(const Part& part);

/// What statics gives for the loads.
struct Static {
  algebra::Vector reactions;  ///< of Part::held, on w
  algebra::Vector w;          ///< displacements that the laws answer with these
  OnCells stress;
};
/// Nothing where a law does not give its reaction at one displacement alone: at a limit, or where there is no solution.
std::optional<Static> by_statics(const Part& part, const Forces& forces);

/// The displacement of these strains with the laws' displacements w, and no part in motions that no law notices.
algebra::Vector displacement(const Part& part, const OnCells& strain, const algebra::Vector& w);

/// u less its part in the motions that no law of the part notices.
void remove_unnoticed(const Part& part, Eigen::Ref<algebra::Vector> u);

}  // namespace dotyk::thermoelastic

#pragma once

#include "plate/solution.hpp"

namespace dotyk::plate {

/// How far one solution is from another, relative to the other.
struct Distance {
  double energy = 0;        ///< √∫ D (κ − κ')ᵀC(κ − κ') / √∫ D κ'ᵀCκ', curvatures cell by cell, D and ν of the other
  double displacement = 0;  ///< ‖u − u'‖ / ‖u'‖ in L²
};

/// By the load rule of whichever mesh has more cells; points that are not on both plates are left out. Throws InputError where no point is, or the other is zero.
Distance distance(const Solution& solution, const Solution& other);

}  // namespace dotyk::plate

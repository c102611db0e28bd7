// What compose_beam.cpp and compose_law.cpp share.
#pragma once

#include "figure/compose_beam.hpp"
#include "problem/support_graph.hpp"

namespace dotyk::figure {

constexpr double kRounding = 1e-9;  // of the scale: no more than rounding

// Of a solution: what rounding is measured by, what graphs of rigid laws extend over. Never zero.
struct Scales {
  double displacement = 1;  // length, or rad
  double force = 1;         // force, or moment
};
Scales scales(const beam::Solution& solution, LawSide of);

// Zero where it is what rounding left.
struct WorkingPoint {
  double displacement, reaction;  // u and force, or u' and moment
};
WorkingPoint working_point(const beam::Solution& solution, int support, LawSide of);

const problem::SupportLaw& law_of(const beam::Solution& solution, int support, LawSide of);

// Is the law about -u'?
bool turned(const problem::SupportLaw& law, LawSide of);

BeamDrawing beam_drawing(const beam::Solution& solution);

}  // namespace dotyk::figure

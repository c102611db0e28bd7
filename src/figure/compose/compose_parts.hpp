// What compose_beam.cpp and compose_law.cpp share.
#pragma once

#include <string>

#include "figure/compose/compose_beam.hpp"
#include "problem/support_graph.hpp"

namespace dotyk::figure {

// Zero where it is what rounding left.
struct WorkingPoint {
  double displacement, reaction;  // u and force, u' and moment, or u₁ and axial force
};
WorkingPoint working_point(const ViewedLaw& at, const Scales& scale);

BeamDrawing beam_drawing(const BeamView& view);

// " [N]" after the name of a quantity; nothing where units are not given.
inline std::string unit_text(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }

// "N·m"; one alone where the other is not given.
inline std::string joined(const std::string& a, const char* sign, const std::string& b) { return a.empty() || b.empty() ? a + b : a + sign + b; }

}  // namespace dotyk::figure

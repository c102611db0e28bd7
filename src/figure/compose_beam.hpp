// From beams and laws of supports to what their pictures show.
#pragma once

#include <string>
#include <vector>

#include "beam/solution.hpp"
#include "figure/page_picture.hpp"

namespace dotyk::figure {

enum class BeamPanel { deflection, moment, shear };

// Names beside axes; empty: none.
struct Units {
  std::string length, force;
};

// Panels one below the other over one x axis. Diagrams jump where the moment or the shear does, and what rounding left
// of one that vanishes is zero.
PagePicture compose(const beam::Solution& solution, const std::vector<BeamPanel>& panels, const Units& units);

// What a law is about: the deflection, or the rotation of a beam.
enum class LawSide { deflection, rotation };

// The graph of reaction against displacement, and the superpotential beside it. One-sided laws of a rotation resist
// slopes above zero: their graphs are turned by half a turn.
PagePicture compose(const problem::SupportLaw& law, LawSide of, const Units& units);
// The same with the working point of a solved support on it.
PagePicture compose(const beam::Solution& solution, int support, LawSide of, const Units& units);

// A row of the gallery: the beam, the graph of one of its laws with the working point, its superpotential.
struct GalleryRow {
  std::string title;
  const beam::Solution* solution;
  int support;
  LawSide of;
};
PagePicture compose(const std::vector<GalleryRow>& rows);

}  // namespace dotyk::figure

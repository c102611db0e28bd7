// From beams and laws of supports to what their pictures show.
#pragma once

#include <string>
#include <vector>

#include "figure/compose/beam_view.hpp"
#include "figure/page/page_picture.hpp"

namespace dotyk::figure {

// Names beside axes; empty: none.
struct Units {
  std::string length = {}, force = {}, temperature = {};
};

// Panels one below the other over one x axis, each among the view's diagrams or the deflection. Diagrams jump where the
// moment or the shear does, and what rounding left of one that vanishes is zero.
PagePicture compose(const BeamView& view, const std::vector<BeamPanel>& panels, const Units& units);

// The graph of reaction against displacement, and the superpotential beside it. One-sided laws of a rotation resist
// slopes above zero: their graphs are turned by half a turn.
PagePicture compose(const problem::SupportLaw& law, LawSide of, const Units& units);
// The same with the working point of a support on it; so are those of a displacement turned at the right end.
PagePicture compose(const BeamView& view, int support, LawSide of, const Units& units);

// A row of the gallery: the beam, the graph of one of its laws with the working point, its superpotential.
struct GalleryRow {
  std::string title;
  BeamView view;
  int support;
  LawSide of;
};
PagePicture compose(const std::vector<GalleryRow>& rows);

}  // namespace dotyk::figure

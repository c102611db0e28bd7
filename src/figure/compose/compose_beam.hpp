// From beams, whatever model they come from, and laws of supports to what their pictures show.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "beam/solution.hpp"
#include "figure/page/page_picture.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::figure {

enum class BeamPanel { deflection, moment, shear, normal, temperature, gradient, displacement };

// What a law is about: the deflection, the rotation of a beam, or the displacement along it.
enum class LawSide { deflection, rotation, displacement };

constexpr double kRounding = 1e-9;  // of the scale: no more than rounding

// What rounding is measured by, what graphs of rigid laws extend over. Positive.
struct Scales {
  double displacement = 1;  // length, or rad
  double force = 1;         // force, or moment
};

// A law of a support, and where on its graph the support is.
struct ViewedLaw {
  problem::LawChoice law;
  double displacement = 0;  // u, u' or u₁
  double reaction = 0;      // on the beam: up, anticlockwise, along x
  bool turned = false;      // the law is about what is opposite to the displacement
  double place = 0;         // the law is about displacement - place
  double force = 0;         // of the reaction: what is added beside the law
};

struct ViewedSupport {
  double x = 0;
  ViewedLaw deflection, rotation, displacement;
  const ViewedLaw& of(LawSide side) const;
};

// A force or moment within the beam, or a field along it; of x on the beam, to the right of x where it jumps.
struct Diagram {
  struct Jump {
    double x, by;
  };
  std::function<double(double)> value;
  std::vector<Jump> jumps;
  double scale = 0;  // of what it is computed from
};

// Functions refer to the model they are of.
struct BeamView {
  double length = 1;
  std::vector<double> nodes;
  std::function<double(double)> deflection;
  std::function<double(double)> load;  // per length, upwards; empty: none
  std::vector<BeamLoad> loads;         // at points, laws that are loads left out
  std::vector<ViewedSupport> supports;
  std::map<BeamPanel, Diagram> diagrams;
  Scales bending, axial;               // of forces and lengths
  std::string doubt;                   // of a solution that has not converged; else empty
};

Scales scales(const BeamView& view, LawSide of);

BeamView view(const beam::Solution& solution);
// At the present time; `load`: the one along the beam at that time, empty: none.
BeamView view(const thermoelastic::Stepping& stepping, std::function<double(double)> load);

// One-sided laws are about −u', and at the right end about −u₁.
bool turned(const problem::LawChoice& law, LawSide of, bool right_end = false);

// Names beside axes; empty: none.
struct Units {
  std::string length = {}, force = {}, temperature = {};
};

// Panels one below the other over one x axis, each among the view's diagrams or the deflection. Diagrams jump where the
// moment or the shear does, and what rounding left of one that vanishes is zero.
PagePicture compose(const BeamView& view, const std::vector<BeamPanel>& panels, const Units& units);

// The graph of reaction against displacement, and the superpotential beside it. One-sided laws of a rotation resist
// slopes above zero: their graphs are turned by half a turn.
PagePicture compose(const problem::LawChoice& law, LawSide of, const Units& units);
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

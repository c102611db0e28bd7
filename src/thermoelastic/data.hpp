#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "beam/beam.hpp"

namespace dotyk::thermoelastic {

/// What a support does at its point. One-sided laws keep the deflection up (u₂ ≥ 0), the slope down (u₂' ≤ 0) and the
/// beam's ends within their places: u₁ ≥ 0 at the left one, u₁ ≤ 0 at the right one.
struct Support {
  std::string name;  ///< "left", "right", "x = 0.5"
  double x = 0;
  problem::LawChoice deflection, rotation;
  problem::LawChoice displacement;  ///< along the axis; at the ends alone
};

/// Is ϑ₁, or ϑ₂, prescribed at an end (Loads says to what)? Otherwise no heat passes there.
struct HeldHeat {
  bool mean = false, gradient = false;
};

/// A beam of rectangular section in the linear coupled thermoelasticity of P4, quasi-static. At height z over the axis
/// it is warmer than the reference by ϑ₁ + zϑ₂; u₁ is the displacement along the axis, u₂ the deflection, upwards:
///   a₁ ∂ₜϑ₁ = D²ϑ₁ − a₁₁ϑ₁ − a₁₂ϑ₂ − a₂ ∂ₜDu₁ + r₁,     −D(EF (Du₁ − αϑ₁)) = p
///   a₁ ∂ₜϑ₂ = D²ϑ₂ − a₂₂ϑ₂ − a₂₁ϑ₁ + a₂ ∂ₜD²u₂ + r₂,    D²(EJ (D²u₂ + αϑ₂)) = q
/// N = EF (Du₁ − αϑ₁) pulls where positive (P4 has the other sign), M = −EJ (D²u₂ + αϑ₂), T = DM.
///
/// Exchange of heat damps, which asks for F a₁₂ = J a₂₁ with one sign; for this and other misprints of P4 see scripts/papers/README.md, 60 to 79.
///
/// A support with a breaking law breaks when its reaction reaches the limit, and bears nothing from then on (P4, section 4,
/// figures 16 and 17; there without a memory). The beam jumps without exchanging heat: Cϑ − Gᵀu stays.
struct Data {
  double length = 1, height = 0.1, width = 1;
  double E = 1;               ///< Young's modulus, stress
  double expansion = 0;       ///< α, 1/temperature
  std::function<double(double)> E_of, expansion_of;  ///< of x, at the middles of the cells; empty: constant
  double conductivity = 1;    ///< k, power/(length·temperature)
  double heat_capacity = 1;   ///< per volume, energy/(length³·temperature)
  double reference = 293.15;  ///< θ₀, absolute temperature
  double exchange_above = 0;  ///< α_h, power/(length²·temperature), on the face z = height/2
  double exchange_below = 0;  ///< α_d
  int cells = 32;
  std::vector<Support> supports;  ///< ascending in x; the first and the last one are the ends
  std::array<HeldHeat, 2> heat_ends;
};

/// Throws InputError where a number is not positive (expansion and exchange: negative), a law is not valid, two supports
/// are at one point, or one lies off the beam.
void require_valid(const Data& data);

/// Its length, cells and supports as of a plain beam: what theorems 2 to 5 and the nodes are about.
beam::Beam plain(const Data& data);

/// The coefficients of P4 (a₂ with the constants E and α), and those of the energy: the equation of ϑ₁ times kF/θ₀, that of ϑ₂ times kJ/θ₀.
struct Coefficients {
  explicit Coefficients(const Data& data);
  double F, J;  ///< area and second moment of the section
  double a1, a2, a11, a12, a21, a22;
  double weight_mean, weight_gradient;  ///< kF/θ₀ and kJ/θ₀
};

/// The nodes, ascending: cells of equal length, and the supports' points where they are not (nearly) among them.
std::vector<double> nodes(const Data& data);

/// A number, or a function of x and t.
struct Source {
  double constant = 0;
  std::function<double(double x, double t)> of;  ///< empty: the constant
};
/// A number, or a function of t.
struct History {
  double constant = 0;
  std::function<double(double t)> of;
  double operator()(double t) const { return of ? of(t) : constant; }
};

/// What drives a support about one displacement v: its law is about v − place, and `force` is added to its reaction.
struct Drive {
  History place;  ///< a settlement û(t); length, of a rotation rad
  History force;  ///< T̂(t), M̂(t) of P4 as acting on the beam: up, anticlockwise, along x
};
/// Of the support at x.
struct SupportLoads {
  double x = 0;
  Drive deflection, rotation, displacement;
};

/// What drives the beam. Functions are called during the calls that they are given to and not kept.
struct Loads {
  Source transverse;                      ///< q, upwards, force/length
  Source axial;                           ///< p, along x, force/length
  Source heat;                            ///< power/volume, the same at every height
  Source heat_gradient;                   ///< its slope in z, power/volume/length
  History ambient_above, ambient_below;   ///< over the reference
  std::array<History, 2> mean, gradient;  ///< ϑ₁ and ϑ₂ at the ends where they are prescribed
  std::vector<SupportLoads> supports;     ///< in any order; a support that is not here is driven by nothing
};

/// ϑ₁ and ϑ₂ at t = 0.
struct Initial {
  Source mean, gradient;
};

}  // namespace dotyk::thermoelastic

#pragma once

namespace dotyk::channel {

/// The modified Hartmann problem (Hlavacova, Hlavac: motion of a liquid in a magnetohydrodynamic
/// channel by separation of variables). A conducting liquid between walls y = +-y0 flows along x
/// with velocity u(y, t), across a magnetic field B along y and an electric field E along z:
///
///   rho u_t - eta u_yy + sigma B^2 u = -p_x - sigma E B,   u(+-y0, t) = 0.                  (13)
///
/// Divided by sigma E0 B0, with the z axis turned so that E = -E0 cos wt (first combination of
/// fields, B = B0) or E = -E0 (second one, B = B0 cos wt):
///
///   first:   a u_t - b u_yy + c u          = d + cos wt,                                    (15)
///   second:  a u_t - b u_yy + c cos^2(wt) u = d + cos wt,
///   a = rho/(sigma E0 B0),  b = eta/(sigma E0 B0),  c = B0/E0,  d = -p_x/(sigma E0 B0).
///
/// The second neglects, as the paper does throughout, the electric field that a changing B induces.
///
/// Initial profile (36), (37): u0 (1 - (|y|/y0)^p), p = log10(Re + 1), Re = sqrt(2) y0 rho |u0|/eta.
/// The logarithm is the decadic one, as Czech texts write it (the natural one is ln there).
///
/// Where the paper is printed otherwise see misprints 48 to 58 in scripts/papers/README.md; (13), (18), (20), (28)-(32), (34),
/// (35) and the phases of (38) are right as printed.

enum class Oscillating { electric, magnetic };  ///< first, second combination of fields

/// Of (15) or its second form, in any consistent units; `drive` stands before cos wt (1 in the paper,
/// 0 takes the oscillating force away).
struct Data {
  double half_width = 0;  ///< y0, length
  double a = 0, b = 0, c = 0, d = 0, drive = 1;
  double omega = 0;          ///< angular frequency w, 1/time
  double initial_speed = 0;  ///< u0, velocity; 0 starts from rest
  Oscillating oscillating = Oscillating::electric;
};

/// SI units: kg/m^3, Pa s, S/m, V/m, T, Pa/m, m, 1/s, m/s.
struct Physical {
  double half_width = 0, density = 0, viscosity = 0, conductivity = 0;
  double E0 = 0, B0 = 0;             ///< amplitudes of the fields, E = -E0 along z
  double pressure_gradient = 0;      ///< p_x; negative drives the flow along x
  double omega = 0, initial_speed = 0;
  Oscillating oscillating = Oscillating::electric;
};

/// a, b, c, d as above. Where E0 or B0 is 0 there is nothing to divide by and nothing that
/// oscillates: a = rho, b = eta, c = sigma B0^2, d = -p_x, drive = 0. Throws InputError as check().
Data reduced(const Physical& physical);

/// Throws InputError unless all is finite, y0, a, b > 0, c, w >= 0, and w > 0 where B oscillates.
void check(const Data& data);

double reynolds(const Data& data);  ///< sqrt(2) y0 |u0| a/b, as a/b = rho/eta
double exponent(const Data& data);  ///< p = log10(Re + 1)
double hartmann(const Data& data);  ///< M = y0 sqrt(c/b), as c/b = sigma B0^2/eta
double initial_velocity(const Data& data, double y);

/// What multiplies u at time t: c, or c cos^2 wt.
double resistance(const Data& data, double t);
double force(const Data& data, double t);  ///< d + drive cos wt

/// Throws InputError unless |y| <= y0.
void check_inside(const Data& data, double y);

}  // namespace dotyk::channel

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
/// What the print has, and what was computed with here:
///   (7)    -p delta_ij is counted again in (5), (6)      tau without the pressure
///   (12)   rho v_t - lap v = ...                         rho v_t - eta lap v = ...
///   (14)   -sigma E_z B_y drives w                       j x B has no such z component: E_x stands there;
///                                                        for E along z nothing drives w
///   (15)   d = p_x/(E0 B0)                               d = -p_x/(sigma E0 B0): p_x changes sides in (13),
///                                                        and a, b hold sigma while d does not (units)
///   (15)   + cos wt with E = E0 cos wt                   + cos wt belongs to E = -E0 cos wt; with E as printed
///                                                        it is - cos wt (a phase of half a period)
///   (17)   u(+-y0, 0) = 0                                u(+-y0, t) = 0
///   (38)   solves (15), but not from rest as promised:   - exp(-lambda_k t) (lambda_k/(w^2 + lambda_k^2) + d/lambda_k)
///          at t = 0 the sum of (30) and (38) is not v     is missing in its bracket. Its factor 4/(a pi) is right.
///   (39)   u(y), profile of the steady channel            its value on the axis; the profile has
///                                                        cosh(M y/y0)/cosh M in place of 1/cosh M. Its signs are
///                                                        those of (13) and contradict (15) as printed.
///   M (31) called the magnetic Mach number               the Hartmann number
///   text   u is the sum of (19) and (38)                  of (30) and (38)
///   text   (13), (14) divided by E0 B0                    by sigma E0 B0, as a and b have it
///   text   sigma >> eps mu; Ohm's law (11)                sigma >> w eps, as (4) has it (units); Ohm's law is (10)
///   text   amplitude falls "w times" against steady E    (38) has 1/(a sqrt(w^2 + lambda_k^2)) against 1/(a lambda_k):
///                                                        a factor lambda_k/w, a number, for w >> lambda_k; on the
///                                                        axis of the channel the amplitude tends to 1/(a w)
/// Checked and right as printed: (13), (18), (20), (28)-(32), (34), (35), phases of (38).

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

#pragma once

#include <complex>

namespace dotyk::channel {

using Complex = std::complex<double>;

/// h(y) of gamma h - b h'' = 1, h(+-y0) = 0, |y| <= y0, b > 0, Re gamma >= 0:
///
///   h = (1 - cosh(m y)/cosh(m y0))/gamma,  m^2 = gamma/b;   (y0^2 - y^2)/(2b) for gamma = 0.
///
/// gamma = c: the profile of the steady channel for a unit force, (39) off the axis.
/// gamma = c + i a w: Re(h e^{iwt}) is the periodic solution for the force cos wt, the closed sum of (38).
/// Computed without cancellation for small m and without overflow for large.
Complex forced_profile(double y, double y0, double b, Complex gamma);

}  // namespace dotyk::channel

#include "channel/data.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dotyk::channel {
namespace {

void need(bool holds, const char* name, double value, const char* must) {
  if (!(holds && std::isfinite(value))) throw InputError(text(name, " is ", value, "; it must be ", must));
}
void positive(const char* name, double value) { need(value > 0, name, value, "positive and finite"); }
void not_negative(const char* name, double value) { need(value >= 0, name, value, "finite and not negative"); }
void finite(const char* name, double value) { need(true, name, value, "finite"); }

}  // namespace

Data reduced(const Physical& f) {
  positive("density", f.density);
  positive("viscosity", f.viscosity);
  positive("conductivity", f.conductivity);
  finite("E0", f.E0);
  finite("B0", f.B0);
  finite("pressure_gradient", f.pressure_gradient);
  if (f.E0 < 0 || f.B0 < 0) throw InputError(text(f.E0 < 0 ? "E0 is " : "B0 is ", f.E0 < 0 ? f.E0 : f.B0,
                                                  "; amplitudes of fields must not be negative"));
  const bool driven = f.E0 > 0 && f.B0 > 0;
  const double scale = driven ? f.conductivity * f.E0 * f.B0 : 1;
  Data data;
  data.half_width = f.half_width;
  data.a = f.density / scale;
  data.b = f.viscosity / scale;
  data.c = f.conductivity * f.B0 * f.B0 / scale;
  data.d = (0 - f.pressure_gradient) / scale;
  data.drive = driven ? 1 : 0;
  data.omega = f.omega;
  data.initial_speed = f.initial_speed;
  data.oscillating = f.oscillating;
  check(data);
  return data;
}

void check(const Data& data) {
  positive("half_width", data.half_width);
  positive("a", data.a);
  positive("b", data.b);
  not_negative("c", data.c);
  finite("d", data.d);
  finite("drive", data.drive);
  not_negative("omega", data.omega);
  finite("u0", data.initial_speed);
  if (data.oscillating == Oscillating::magnetic) positive("omega of an oscillating magnetic field", data.omega);
}

double reynolds(const Data& data) {
  return std::sqrt(2.0) * data.half_width * std::abs(data.initial_speed) * data.a / data.b;
}

double exponent(const Data& data) { return std::log1p(reynolds(data)) / std::log(10.0); }

double hartmann(const Data& data) { return data.half_width * std::sqrt(data.c / data.b); }

double initial_velocity(const Data& data, double y) {
  if (data.initial_speed == 0) return 0;
  return data.initial_speed * (1 - std::pow(std::abs(y) / data.half_width, exponent(data)));
}

double resistance(const Data& data, double t) {
  const double wave = data.oscillating == Oscillating::magnetic ? std::cos(data.omega * t) : 1;
  return data.c * wave * wave;
}

double force(const Data& data, double t) { return data.d + data.drive * std::cos(data.omega * t); }

void check_inside(const Data& data, double y) {
  if (!(std::abs(y) <= data.half_width))
    throw InputError(text("y = ", y, " is outside the channel, |y| <= ", data.half_width));
}

}  // namespace dotyk::channel

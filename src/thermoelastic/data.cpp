#include "thermoelastic/data.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dotyk::thermoelastic {

beam::Beam plain(const Data& data) {
  beam::Beam beam;
  beam.length = data.length;
  beam.cells = data.cells;
  for (const Support& s : data.supports) beam.supports.push_back({s.name, s.x, s.deflection, s.rotation});
  return beam;
}

namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0) || !std::isfinite(value)) throw InputError(text("its ", what, " is ", value, "; it must be positive"));
}

void require_not_negative(double value, const char* what) {
  if (!(value >= 0) || !std::isfinite(value))
    throw InputError(text("its ", what, " is ", value, "; it must be zero or positive"));
}

}  // namespace

void require_valid(const Data& data) {
  beam::require_valid(plain(data));
  require_positive(data.height, "height");
  require_positive(data.width, "width");
  if (!data.E_of) require_positive(data.E, "Young's modulus E");
  require_positive(data.conductivity, "conductivity");
  require_positive(data.heat_capacity, "heat capacity");
  require_positive(data.reference, "reference temperature (absolute)");
  if (!data.expansion_of) require_not_negative(data.expansion, "expansion");
  require_not_negative(data.exchange_above, "heat exchange above");
  require_not_negative(data.exchange_below, "heat exchange below");
  if (data.length < data.height / 1000)
    throw InputError(
        text("its length is ", data.length, " and its height ", data.height, ": no beam, whose length is many times its height"));
  for (const Support& s : data.supports) require_valid(s.displacement);
}

Coefficients::Coefficients(const Data& d)
    : F(d.width * d.height),
      J(d.width * std::pow(d.height, 3) / 12),
      a1(d.heat_capacity / d.conductivity),
      a2(d.reference * d.E * d.expansion / d.conductivity),
      a11((d.exchange_above + d.exchange_below) / (d.conductivity * d.height)),
      a12((d.exchange_above - d.exchange_below) / (2 * d.conductivity)),
      a21(6 * (d.exchange_above - d.exchange_below) / (d.conductivity * d.height * d.height)),
      a22(12 / (d.height * d.height) + 3 * (d.exchange_above + d.exchange_below) / (d.conductivity * d.height)),
      weight_mean(d.conductivity * F / d.reference),
      weight_gradient(d.conductivity * J / d.reference) {}

std::vector<double> nodes(const Data& data) { return beam::nodes(plain(data)); }

}  // namespace dotyk::thermoelastic

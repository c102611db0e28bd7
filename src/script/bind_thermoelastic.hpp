#pragma once
// Thermoelastic beams, as scripts hold them. Functions of their loads are kept with the object.
#include "script/wrapped.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::script {

struct ThermoelasticBeam {
  std::unique_ptr<thermoelastic::Stepping> stepping;
  thermoelastic::Loads constants;
  bool stepping_now = false;  // its functions may not step it
};
template <>
struct Wrapped<ThermoelasticBeam> {
  static constexpr const char* name = "thermoelastic_beam";
};

}  // namespace dotyk::script

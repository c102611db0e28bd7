#pragma once
// Thermoelastic beams, as scripts hold them. Functions of their loads are kept with the object.
#include "script/bridge/call.hpp"
#include "script/bridge/wrapped.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::script {

struct ThermoelasticBeam {
  std::unique_ptr<thermoelastic::Stepping> stepping;
  thermoelastic::Loads constants;
  bool loads_called = false;  // its functions may not step it, nor draw it
};
template <>
struct Wrapped<ThermoelasticBeam> : Called<"thermoelastic_beam"> {};

// While it is there the object's functions may be called, and a second one is refused with InputError, `what` they cannot do.
class LoadsCalled {
 public:
  LoadsCalled(ThermoelasticBeam& beam, const char* what);
  ~LoadsCalled() { on_ = false; }
  LoadsCalled(const LoadsCalled&) = delete;
  LoadsCalled& operator=(const LoadsCalled&) = delete;

 private:
  bool& on_;
};

// Constants and kept functions of the object before the colon.
thermoelastic::Loads kept_loads(Call& call, const ThermoelasticBeam& beam);

}  // namespace dotyk::script

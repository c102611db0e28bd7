#pragma once
// Flows that the tests share, in units of the channel: y0 = 1, diffusion time 1.
#include "base/monitor.hpp"
#include "channel/data.hpp"

namespace flows {

inline dotyk::Monitor quiet;  // never stops

inline dotyk::channel::Data electric() {
  dotyk::channel::Data data;
  data.half_width = 1;
  data.a = 1;
  data.b = 1;
  data.c = 9;
  data.d = 3;
  data.omega = 20;
  data.initial_speed = 700;  // p = log10(990.9...) = 2.996, between smooth exponents
  return data;
}

inline dotyk::channel::Data magnetic() {
  dotyk::channel::Data data = electric();
  data.oscillating = dotyk::channel::Oscillating::magnetic;
  data.c = 60;
  return data;
}

}  // namespace flows

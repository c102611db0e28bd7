#pragma once
// The keys "size" and "units" of everything that draws.
#include "figure/compose/compose_beam.hpp"
#include "script/bridge/arguments.hpp"

namespace dotyk::script {

Key size_key(const char* otherwise);

// Both pixel counts of "size", where it is given. Throws InputError where one is out of range.
void read_size(const Arguments& call, int& width, int& height);

// Names of the units of length and force, of temperature too where there is `heat`.
Key units_key(bool heat = false);
figure::Units read_units(const Arguments& call, bool heat = false);

}  // namespace dotyk::script

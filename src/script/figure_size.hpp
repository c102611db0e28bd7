#pragma once
// The key "size" of everything that draws.
#include "script/arguments.hpp"

namespace dotyk::script {

Key size_key(const char* otherwise);

// Both pixel counts of "size", where it is given. Throws InputError where one is out of range.
void read_size(const Arguments& call, int& width, int& height);

}  // namespace dotyk::script

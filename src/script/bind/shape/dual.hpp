#pragma once
// Dual numbers of scripts (lua/dual.lua): a value and its gradient.
#include "algebra/types.hpp"
#include "script/bridge/lua.hpp"

namespace dotyk::script {

struct Dual {
  double value = 0;
  algebra::Vector gradient;
};

void push(lua_State* L, const Dual& dual);

// The dual number on top of the stack, which is taken off; where `size` is 0, also a number. Throws std::runtime_error,
// beginning with `what`, for anything else, another size, and numbers that are not finite.
Dual take_dual(lua_State* L, Eigen::Index size, const std::string& what);

}  // namespace dotyk::script

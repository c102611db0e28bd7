#pragma once

// Laws of supports that most tests of beams and plates need.
#include "problem/support_law.hpp"

namespace dotyk::test {

inline constexpr problem::SupportLaw kFree{}, kHeld{problem::SupportLaw::Kind::prescribed, 0, 0};

}  // namespace dotyk::test

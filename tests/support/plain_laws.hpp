#pragma once

// Laws of supports that most tests of beams and plates need.
#include "problem/law_choice.hpp"

namespace dotyk::test {

inline constexpr problem::LawChoice kFree{}, kHeld{&problem::laws::prescribed, 0, 0};

}  // namespace dotyk::test

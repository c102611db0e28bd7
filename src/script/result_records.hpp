#pragma once
// Tables that solutions of several models have in common.
#include "problem/condensed_block.hpp"
#include "problem/residual.hpp"
#include "script/push.hpp"

namespace dotyk::script {

Record time_record(const problem::Clock& clock);
Record residual_record(const problem::Residual& residual);

}  // namespace dotyk::script

#pragma once
// Tables that solutions of several models have in common.
#include "problem/condensed_block.hpp"
#include "problem/residual.hpp"
#include "script/bridge/push.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::script {

inline std::vector<double> list(const algebra::Vector& v) { return {v.begin(), v.end()}; }
Record time_record(const problem::Clock& clock);
Record residual_record(const problem::Residual& residual);
std::vector<Record> history_records(const solver::Result& result);

}  // namespace dotyk::script

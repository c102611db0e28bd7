#pragma once
// Tables that solutions of several models have in common.
#include "problem/condensed.hpp"
#include "problem/residual.hpp"
#include "script/bridge/push.hpp"
#include "script/prompt/watch.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::script {

inline std::vector<double> list(const algebra::Vector& v) { return {v.begin(), v.end()}; }

inline Record time_record(const problem::Clock& t) {
  return {"time", {{"total", t.total}, {"assembly", t.assembly}, {"motions", t.motions}, {"ordering", t.ordering}, {"factor", t.factor},
                   {"iterate", t.iterate}, {"recover", t.recover}}};
}

inline Record residual_record(const problem::Residual& r) {
  return {"residual", {{"equilibrium", r.equilibrium}, {"penetration", r.penetration},
                       {"complementarity", r.complementarity}, {"friction", r.friction}, {"law", r.law}}};
}

inline std::vector<Record> history_records(const solver::Result& result) {
  std::vector<Record> rows;
  for (const IterationInfo& info : result.history) rows.push_back(iteration_record(info));
  return rows;
}

}  // namespace dotyk::script

#include "script/bind/result_records.hpp"

#include "script/prompt/watch.hpp"

namespace dotyk::script {

Record time_record(const problem::Clock& t) {
  return {"time", {{"total", t.total}, {"assembly", t.assembly}, {"motions", t.motions}, {"ordering", t.ordering}, {"factor", t.factor},
                   {"iterate", t.iterate}, {"recover", t.recover}}};
}

Record residual_record(const problem::Residual& r) {
  return {"residual", {{"equilibrium", r.equilibrium}, {"penetration", r.penetration},
                       {"complementarity", r.complementarity}, {"friction", r.friction}, {"law", r.law}}};
}

std::vector<Record> history_records(const solver::Result& result) {
  std::vector<Record> rows;
  for (const IterationInfo& info : result.history) rows.push_back(iteration_record(info));
  return rows;
}

}  // namespace dotyk::script

#pragma once
// Everything a script sees, one function per file bind_*.cpp, and what these files share.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "problem/condensed.hpp"
#include "problem/residual.hpp"
#include "script/bind/setups.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/wrapped.hpp"
#include "script/prompt/watch.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::script {

void bind_all(Library& library);

void bind_material(Library& library);
void bind_mesh(Library& library);
void bind_refinement(Library& library);
void bind_repeated(Library& library);
void bind_shape(Library& library);
void bind_body(Library& library);
void bind_scene(Library& library);
void bind_methods(Library& library);
void bind_ranks(Library& library);
void bind_solver(Library& library);
void bind_solution(Library& library);
void bind_figure(Library& library);
void bind_picture(Library& library);  // by bind_figure
void bind_program(Library& library);
void bind_fclib(Library& library);
void bind_law(Library& library);
void bind_beam(Library& library);
void bind_beam_figure(Library& library);
void bind_plate(Library& library);
void bind_plate_solution(Library& library);
void bind_channel(Library& library);
void bind_thermoelastic(Library& library);
void bind_lua(Library& library);

inline std::vector<double> list(const algebra::Vector& v) { return {v.begin(), v.end()}; }

// Tables that solutions of several models have in common.
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

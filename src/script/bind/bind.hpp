#pragma once
// Everything a script sees, one function per file bind_*.cpp, and what these files share.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "script/bind/result_records.hpp"
#include "script/bind/setups.hpp"
#include "script/bridge/bound.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/wrapped.hpp"
#include "script/prompt/watch.hpp"

namespace dotyk::script {

void bind_all(Library& library);

void bind_material(Library& library);
void bind_mesh(Library& library);
void bind_mesh_file(Library& library);
void bind_refinement(Library& library);
void bind_repeated(Library& library);
void bind_shape(Library& library);
void bind_body(Library& library);
void bind_scene(Library& library);
void bind_contact(Library& library);
void bind_solver(Library& library);
void bind_all_solutions(Library& library);
void bind_solution(Library& library);
void bind_figure(Library& library);
void bind_program(Library& library);
void bind_lcp(Library& library);
void bind_fclib(Library& library);
void bind_law(Library& library);
void bind_beam(Library& library);
void bind_beam_figure(Library& library);
void bind_plate(Library& library);
void bind_plate_solution(Library& library);
void bind_channel(Library& library);
void bind_thermoelastic(Library& library);
void bind_lua(Library& library);

}  // namespace dotyk::script

#include "script/bind/bind.hpp"

#include "script/help/help.hpp"

namespace dotyk::script {

void bind_all(Library& library) {
  library.module("dotyk", "Unilateral contact problems: describe bodies and contacts, solve, look.");
  bind_help(library);
  bind_material(library);
  bind_mesh(library);
  bind_mesh_file(library);
  bind_refinement(library);
  bind_body(library);
  bind_scene(library);
  bind_solver(library);
  bind_all_solutions(library);
  bind_repeated(library);
  bind_shape(library);
  bind_solution(library);
  bind_figure(library);
  bind_program(library);
  bind_lcp(library);
  bind_fclib(library);
  bind_law(library);
  bind_beam(library);
  bind_channel(library);
  bind_thermoelastic(library);
  bind_beam_figure(library);
  bind_plate(library);
}

}  // namespace dotyk::script

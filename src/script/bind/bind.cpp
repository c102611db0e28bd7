#include "script/bind/bind.hpp"

#include "script/help/help.hpp"

namespace dotyk::script {

void bind_all(Library& library) {
  library.module("dotyk", "Unilateral contact problems: describe bodies and contacts, solve, look.");
  for (const auto bind :
       {bind_help, bind_material, bind_mesh, bind_mesh_file, bind_refinement, bind_body, bind_scene,
        bind_solver, bind_all_solutions, bind_repeated, bind_shape, bind_solution, bind_figure, bind_program,
        bind_lcp, bind_fclib, bind_law, bind_beam, bind_channel, bind_thermoelastic, bind_beam_figure,
        bind_plate, bind_lua})
    bind(library);
}

}  // namespace dotyk::script

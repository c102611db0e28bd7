#include "figure/compose/compose_grid.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/models/bind_plate.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {
namespace {

template <class Solution>
int write(Call& call) {
  figure::write(figure::compose_grid(*call.self<Solution>(), call.text("file")));
  return call.give(call.text("file"));
}

Key file_key() { return key::file("file", "where to; ends in .vtu, its folder must exist").written().required(); }

}  // namespace

void bind_write(Library& library) {
  library.extend<scene::Solution>().method(
      {.name = "solution:write",
       .help = "Writes the whole solution for ParaView and returns the file's name: all bodies at rest, their cells "
               "numbered by \"body\", with displacement, stress, von_mises and, where there is contact, "
               "contact_pressure, contact_gap and contact_status (0 open, 1 closed, 2 stick, 3 slip, -1 no contact) "
               "at the nodes; of contacts whose nodes do not match at the first part's alone.",
       .example = "s:write \"a.vtu\"",
       .arguments = {file_key()},
       .run = write<scene::Solution>});
  library.extend<plate::Solution>().method(
      {.name = "plate_solution:write",
       .help = "Writes the solution for ParaView and returns the file's name: the plate at rest, with displacement (along z), moment and, where there "
               "is an obstacle, obstacle_force at the nodes.",
       .example = "s:write \"a.vtu\"",
       .arguments = {file_key()},
       .run = write<plate::Solution>});
}

}  // namespace dotyk::script

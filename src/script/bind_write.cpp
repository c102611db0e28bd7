#include "figure/compose_grid.hpp"
#include "script/bind.hpp"
#include "script/library.hpp"
#include "script/wrapped.hpp"

namespace dotyk::script {

using scene::Solution;

void bind_write(Library& library) {
  library.extend<Solution>().method(
      {.name = "solution:write",
       .help = "Writes the whole solution for ParaView and returns the file's name: all bodies at rest, their cells "
               "numbered by \"body\", with displacement, stress, von_mises and, where there is contact, "
               "contact_pressure, contact_gap and contact_status (0 open, 1 closed, 2 stick, 3 slip, -1 no contact) "
               "at the nodes.",
       .example = "s:write \"a.vtu\"",
       .arguments = {key::string("file", "where to; ends in .vtu, its folder must exist").required()},
       .run = [](Call& call) {
         figure::write(figure::compose_grid(*call.self<Solution>(), call.text("file")));
         return call.give(call.text("file"));
       }});
}

}  // namespace dotyk::script

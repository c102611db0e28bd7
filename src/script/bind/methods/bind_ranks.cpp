// Several processes for one script.
#include "multigrid/start_ranks.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {

void bind_ranks(Library& library) {
  library.function(
      {.name = "dotyk.ranks",
       .help = "dotyk.ranks(4) lets multigrid use 4 processes on this machine and returns the number in use. Call it before the first solve by multigrid. This process goes on with the script, "
               "or the prompt. Under mpirun it starts nothing: the count is mpirun's. dotyk --ranks COUNT FILE, and mpirun -n "
               "COUNT ./dotyk FILE, which also knows other machines, do the same from outside. Everything else, and systems of less than 1000 unknowns a rank, "
               "run on this process alone. The default method is chosen for one process: name dotyk.solver.multigrid{}. For bodies with refine it is the default. Where one process dies or runs out of "
               "memory, all end. OPENBLAS_NUM_THREADS=1 keeps BLAS in each of them to one thread.",
       .example = "print(dotyk.ranks())",
       .arguments = {key::integer("count", "of processes, this one included").within(1, 4096).otherwise("as many as there are")},
       .run = [](Call& call) {
         if (call.has("count")) {
           const int count = static_cast<int>(call.number("count"));
           if (count > 1 && Library::of(call.state()).folder) throw InputError("--safe starts no other programs");
           multigrid::start_ranks(count);
         }
         return call.give(multigrid::count_ranks());
       }});
}

}  // namespace dotyk::script

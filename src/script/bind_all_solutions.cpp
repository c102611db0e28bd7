#include "scene/all_solutions.hpp"
#include "script/bind.hpp"
#include "script/library.hpp"
#include "script/setups.hpp"
#include "script/watch.hpp"
#include "script/wrapped.hpp"

namespace dotyk::script {
namespace {

int all_solutions(Call& call) {
  Watch watch(call.state(), "enumerating");
  const scene::AllSolutions all = scene::all_solutions(call.object<scene::Scene>("scene"), watch);
  watch.answer();
  return call.give(all.solutions, all.summary);
}

}  // namespace

void bind_all_solutions(Library& library) {
  library.function(
      {.name = "dotyk.all_solutions",
       .help = "Every solution of a plane scene with few contact nodes, found by trying each combination of open, "
               "stick and slip to either side, up to 2^20 of them (ten nodes with Coulomb friction): a list of "
               "solutions, empty where there is none, and what was tried in words. With a great coefficient of "
               "friction there may be several; a method finds at most one of them.",
       .setup = setup::few_nodes(),
       .example = "local all, tried = dotyk.all_solutions(scene)\nprint(#all, tried)\n"
                  "for k, s in ipairs(all) do print(k, s.energy, s.reason) end",
       .arguments = {key::object<scene::Scene>("scene", "what to solve").required()},
       .run = all_solutions});
}

}  // namespace dotyk::script

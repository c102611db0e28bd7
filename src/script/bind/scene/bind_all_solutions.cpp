#include "scene/solve/all_solutions.hpp"
#include "script/bind/bind.hpp"
#include "script/bridge/library.hpp"
#include "script/bind/setups.hpp"
#include "script/prompt/watch.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {
namespace {

int all_solutions(Call& call) {
  Watch watch(call.state(), "enumerating");
  const scene::AllSolutions all = scene::all_solutions(call.object<scene::Scene>("scene"), watch);
  watch.answer();
  std::vector<Record> families;
  for (const scene::AllSolutions::Family& family : all.families) {
    std::vector<double> ends;
    for (const int end : family.ends) ends.push_back(end + 1);
    families.push_back({"family", {{"dimension", static_cast<long long>(family.dimension)}, {"ends", ends},
                                   {"unbounded", family.unbounded}, {"forces_only", family.forces_only},
                                   {"continuum", static_cast<long long>(family.continuum) + 1}}});
  }
  return call.give(all.solutions, all.summary, families);
}

}  // namespace

void bind_all_solutions(Library& library) {
  library.function(
      {.name = "dotyk.all_solutions",
       .help = "Every solution of a plane scene with few contact nodes, found by trying each combination of open, "
               "stick and slip to either side, up to 2^20 of them (ten nodes with Coulomb friction): a list of "
               "solutions, empty where there is none, and what was tried in words. With a great coefficient of "
               "friction there may be several, or a continuum; a method finds at most one of them. Third, a list of families, mostly "
               "empty: a family is all convex combinations of its ends, which follow the isolated solutions in the "
               "list. Fields: dimension, ends (their places in the list), unbounded (there is no end in some direction), forces_only "
               "(displacements are the same), continuum (families that meet have the same number).",
       .setup = setup::few_nodes(),
       .example = "local all, tried = dotyk.all_solutions(scene)\nprint(#all, tried)\n"
                  "for k, s in ipairs(all) do print(k, s.energy, s.reason) end\n"
                  "local _, _, families = dotyk.all_solutions(scene)\n"
                  "for _, f in ipairs(families) do print(f.dimension, all[f.ends[1]].energy) end",
       .arguments = {key::object<scene::Scene>("scene", "what to solve").required()},
       .run = all_solutions});
}

}  // namespace dotyk::script

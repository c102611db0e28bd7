// fuzz_lua SECONDS SEED [FOLDER]: random calls of everything a script can call. Each program begins with a
// small problem or with nothing, then calls random functions and methods with random arguments, made from
// their descriptions; most fit, some do not. A failure is a crash, a statement that goes on for 10 s though
// asked to stop, as by Ctrl-C, after 5, a number that is none (NaN) in a result, or an error that is not one
// line at the user's line. Its script is saved in FOLDER (here) and runs by dotyk alone.
#include <cstdlib>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "machine.hpp"
#include "script/lua.hpp"
#include "values.hpp"

namespace {

using namespace dotyk;
using fuzz::Machine;
using fuzz::Pool;
using fuzz::Values;

// Draws pictures, prints, or solves many times over: seldom, or never. Functions of numbers, as math's, may be none.
int rarity(const std::string& name) {
  if (name.starts_with("dotyk.dual.")) return 0;
  for (const char* never : {"help", "source", "dotyk.work_precision", "dotyk.mesh.gmsh"})
    if (name == never) return 0;
  for (const char* rare : {"render", "chart", "show_law", "optimise", "adapt", "all_solutions"})
    if (name.find(rare) != std::string::npos) return 60;
  return 1;
}

// Problems other than a body on a floor: V[n] is the n-th expression's.
const std::vector<std::vector<std::string>> openings = {
    {"dotyk.law.signorini()", "dotyk.beam{ cells = 4, load = -1, left = { deflection = V[1] }, right = { deflection = V[1], rotation = dotyk.law.elastic(2) } }",
     "dotyk.solve(V[2])"},
    {"dotyk.beam{ cells = 3, load = -1, left = { deflection = dotyk.law.breaking{ k = 2, g = 1 } }, right = { deflection = dotyk.law.elastic(2) } }",
     "dotyk.solve(V[1])"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {3,3} }", "dotyk.plate{ mesh = V[1], load = -1, edge = { deflection = dotyk.law.signorini() } }",
     "dotyk.solve(V[2])"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,3} }",
     "dotyk.plate{ mesh = V[1], load = -1, element = 'HCT', edge = { deflection = dotyk.law.prescribed(0), rotation = dotyk.law.friction(0.1) } }", "dotyk.solve(V[2])"},
    {"dotyk.qp{ B = {{2,0},{0,2}}, c = {2,5}, D = {{1,1}}, d = {1}, x_low = 0 }", "V[1]:solve{}"},
    {"dotyk.lcp{ M = {{1,0,2},{2,1,0},{0,2,1}}, q = {1,-1,1} }"},
    {"dotyk.thermoelastic_beam{ height = 0.1, E = 100, expansion = 1e-3, conductivity = 1, heat_capacity = 1, cells = 4, load = -1, step = 1, "
     "left = { deflection = dotyk.law.signorini(), displacement = dotyk.law.prescribed(0) }, right = { deflection = dotyk.law.signorini() } }",
     "V[1]:run(2)"},
    {"dotyk.channel{ half_width = 1e-3, density = 13546, viscosity = 1.55e-3, conductivity = 1.04e6, E0 = 0.1, B0 = 0.2, pressure_gradient = -2e4, omega = 6.28, u0 = 1 }"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {3,2} }", "dotyk.mesh.rectangle{ from = {0,1}, to = {2,2}, cells = {3,2} }",
     "dotyk.material{ E = 10, nu = 0.3 }", "dotyk.body{ mesh = V[1], material = V[3] }", "dotyk.body{ mesh = V[2], material = V[3] }",
     "V[4]:part 'bottom':fix()", "V[5]:part 'top':load{ 0.02, -0.1 }", "dotyk.scene{ V[4], V[5] }",
     "V[8]:contact{ V[4]:part 'top', V[5]:part 'bottom', friction = dotyk.friction.coulomb(0.4) }",
     "dotyk.solve(V[8], { steps = { { load = 0.5 }, { load = 1 } } })"},
    {"dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {4,2} }", "dotyk.body{ mesh = V[1], material = dotyk.material{ E = 100, nu = 0.3 } }",
     "V[2]:part 'top':load{ 0, -1 }", "V[2]:part 'left':fix 'x'", "V[2]:part 'bottom'", "dotyk.scene{ V[2] }",
     "V[6]:contact{ V[5], rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} } }",
     "dotyk.shape{ scene = V[6], moves = { { part = V[5], control_points = 4, direction = {0,1}, lower = 0, upper = 0.05 } } }", "V[8]:design{ 0.01, 0, 0, 0.01 }"},
    {"dotyk.body{ mesh = dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {3,2} }, material = dotyk.material{ E = 10, nu = 0.3 } }", "V[1]:part 'bottom'",
     "V[1]:part 'top':load{ 0.1, -1 }", "V[1]:part 'left':fix 'x'", "V[2]:support{ normal = dotyk.law.signorini(), tangential = dotyk.law.friction(0.1) }",
     "dotyk.scene{ V[1] }", "dotyk.solve(V[6])", "V[7]:support(V[2])"},
    {"dotyk.body{ mesh = dotyk.mesh.box{ from = {0,0,0}, to = {4,1,1}, cells = {3,1,1}, element = 'Q1' }, material = dotyk.material{ E = 1, nu = 0.3 } }",
     "V[1]:part 'left':fix()", "V[1]:part 'right':load{ 0, 0, -1e-4 }",
     "dotyk.repeated_systems{ scene = dotyk.scene{ V[1] }, method = 'scg', velocities = { function(x, y, z) return 0, 0, z * (1 - x/8) end } }"},
    {"dotyk.mesh.rectangle{ from = {0,0}, to = {2,1}, cells = {2,2}, element = 'P2' }", "dotyk.mesh.rectangle{ from = {0,1}, to = {2,2}, cells = {3,2}, element = 'Q2' }",
     "dotyk.material{ E = 10, nu = 0.3 }", "dotyk.body{ mesh = V[1], material = V[3] }", "dotyk.body{ mesh = V[2], material = V[3] }",
     "V[4]:part 'bottom':fix()", "V[5]:part 'left':fix 'x'", "V[5]:part 'top':load{ 0.02, -0.1 }", "dotyk.scene{ V[4], V[5] }",
     "V[9]:contact{ V[4]:part 'top', V[5]:part 'bottom', friction = dotyk.friction.tresca(0.01) }", "dotyk.solve(V[9])"},
    {"dotyk.refinement{ dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {2,2} } }", "V[1]:refine()"}};

// What a run reached.
struct Reached {
  std::map<std::string, long> made;    // objects that calls gave, by class
  std::map<std::string, long> called;  // random calls by callable that gave a result, which may be nothing
};

class Program {
 public:
  Program(Machine& machine, unsigned seed, Reached& reached) : machine_(machine), reached_(reached), values_(seed, pool_) {}

  void run() {
    if (values_.once_in(2)) begin_with_scene();
    else if (!values_.once_in(4))
      for (const auto& expression : openings[static_cast<std::size_t>(values_.below(static_cast<int>(openings.size())))]) make(expression);
    for (int calls = 3 + values_.below(15); calls > 0; --calls) call_something();
  }

 private:
  // Runs "V[n] = try(…)" and notes what it made.
  void make(const std::string& expression) {
    const std::string name = text("V[", ++made_, "]");
    machine_.run(text(name, " = try(function() return ", expression, " end)"));
    lua_State* L = machine_.state();
    lua_getglobal(L, "V");
    lua_rawgeti(L, -1, made_);
    const auto* type = machine_.library().type_at(L, -1);
    lua_pop(L, 2);
    if (!type) return;
    pool_[type->name].push_back(name);
    ++reached_.made[type->name];
    if (!type->fields.empty() && values_.once_in(3)) look(name, *type);
  }

  void look(const std::string& name, const script::Type& type) {
    std::string fields;
    for (const auto& field : type.fields) fields += ", '" + field.name + "'";
    machine_.run("look(" + name + fields + ")");
  }

  // What most methods need: a body on a rigid floor, and often its solution.
  void begin_with_scene() {
    const bool space = values_.once_in(4);
    const auto count = [&] { return std::to_string(1 + values_.below(space ? 3 : 5)); };
    const std::string element = values_.of({"P1", "Q1", "P2", "Q2"});
    make(space ? text("dotyk.mesh.box{ from = {0,0,0}, to = {1,1,1}, cells = {", count(), ",", count(), ",", count(), "}, element = '", element, "' }")
               : text("dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {", count(), ",", count(), "}, element = '", element, "' }"));
    make("dotyk.material{ E = 100, nu = 0.3 }");
    make("dotyk.body{ mesh = V[1], material = V[2] }");
    make(values_.once_in(3) ? "V[3]:part 'left'" : "V[3]:part 'bottom'");
    make("V[3]:part 'top'");
    make(space ? "V[5]:load{ 0, 0, -1 }" : "V[5]:load{ 0, -1 }");
    if (!values_.once_in(3)) make(values_.once_in(2) ? "V[3]:part 'left':fix()" : "V[3]:part 'left':fix 'x'");
    make("dotyk.scene{ V[3] }");
    const auto& scenes = pool_["scene"];
    if (scenes.empty()) {
      pool_.erase("scene");
      return;
    }
    make(space ? "dotyk.rigid.plane{ point = {0,0,0}, normal = {0,0,1} }" : "dotyk.rigid.plane{ point = {0,0}, normal = {0,1} }");
    if (pool_.count("rigid")) make(text(scenes.back(), ":contact{ V[4], rigid = ", pool_["rigid"].back(), values_.once_in(3) ? ", friction = dotyk.friction.coulomb(0.3)" : "", " }"));
    if (values_.once_in(2)) make(text("dotyk.solve(", scenes.back(), ")"));
  }

  void call_something() {
    const auto& library = machine_.library();
    if (pool_.empty() || values_.once_in(2)) {
      const auto& functions = library.functions();
      const auto& one = functions[static_cast<std::size_t>(values_.below(static_cast<int>(functions.size())))];
      if (wanted(one.name)) call(one, one.name + "(" + values_.arguments(one) + ")");
      return;
    }
    auto some = pool_.begin();
    std::advance(some, values_.below(static_cast<int>(pool_.size())));
    const auto* type = library.find_type(some->first);
    const std::string object = values_.of(some->second);
    if (type->methods.empty()) return;
    const auto& one = type->methods[static_cast<std::size_t>(values_.below(static_cast<int>(type->methods.size())))];
    if (wanted(one.name)) call(one, object + (values_.once_in(60) ? "." : ":") + one.short_name() + "(" + values_.arguments(one) + ")");
  }

  void call(const script::Descriptor& one, const std::string& expression) {
    make(expression);
    lua_State* L = machine_.state();
    reached_.called[one.name] += lua_getglobal(L, "failed") != LUA_TBOOLEAN || !lua_toboolean(L, -1);
    lua_pop(L, 1);
  }

  bool wanted(const std::string& name) {
    const int rare = rarity(name);
    return rare > 0 && values_.once_in(rare);
  }

  Machine& machine_;
  Reached& reached_;
  Pool pool_;
  Values values_;
  int made_ = 0;
};

}  // namespace

int main(int count, char** words) {
  const double seconds = count > 1 ? std::atof(words[1]) : 5;
  const auto first = static_cast<unsigned>(count > 2 ? std::atoll(words[2]) : 1);
  Machine machine(count > 3 ? words[3] : ".");
  const Stopwatch clock;
  double before = 0;
  Reached reached;
  unsigned seed = first;
  for (; clock.seconds() < seconds; ++seed) {
    machine.begin(text("seed_", seed));
    Program(machine, seed, reached).run();
    if (seed - first == 400) before = fuzz::resident();
  }
  std::string objects;
  for (const auto& [type, number] : reached.made) objects += text(objects.empty() ? "" : ", ", number, " ", script::plural(type));
  machine.say("made: " + objects);
  std::string never;
  for (const auto& [name, times] : reached.called)
    if (times == 0) never += (never.empty() ? "" : ", ") + name;
  machine.say("called, but always refused: " + (never.empty() ? "none" : never));
  machine.say(text(machine.executions(), " executions of ", seed - first, " programs (seeds ", first, " to ", seed - 1, ") in ", clock.seconds(), " s, ",
                   machine.failures(), " failures, ", machine.slowest(), "; memory ", fuzz::resident(), " MB", before > 0 ? text(", after 400 programs ", before, " MB") : ""));
  return machine.failures() > 0;
}

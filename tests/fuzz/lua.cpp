// fuzz_lua SECONDS SEED [FOLDER]: random calls of everything a script can call. Each program begins with a
// small problem or with nothing, then calls random functions and methods with random arguments, made from
// their descriptions; most fit, some do not. Functions among them may raise what is no message, yield, collect
// garbage, close coroutines and call dotyk again on what is being worked on (prelude.lua). A failure is a crash, a statement that goes on for 10 s though
// asked to stop, as by Ctrl-C, after 5, a number that is none (NaN) in a result, or an error that is not one
// line at the user's line. Its script is saved in FOLDER (here) and runs by dotyk alone.
#include <cstdlib>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "machine.hpp"
#include "openings.hpp"
#include "script/bridge/lua.hpp"
#include "values.hpp"

namespace {

using namespace dotyk;
using fuzz::Machine;
using fuzz::Pool;
using fuzz::Values;

// Draws pictures, prints, or solves many times over: seldom, or never. Functions of numbers, as math's, may be none.
int rarity(const std::string& name) {
  if (name.starts_with("dotyk.dual.")) return 0;
  for (const char* never : {"dotyk.work_precision", "dotyk.mesh.gmsh"})
    if (name == never) return 0;
  for (const char* rare : {"render", "chart", "show_law", "optimise", "adapt", "all_solutions"})
    if (name.find(rare) != std::string::npos) return 60;
  return 1;
}

// What a run reached.
struct Reached {
  std::map<std::string, long> made;    // objects that calls gave, by class
  std::map<std::string, long> opened;  // expressions of openings that were refused
  std::map<std::string, long> called;  // random calls by callable that gave a result, which may be nothing
};

class Program {
 public:
  Program(Machine& machine, unsigned seed, Reached& reached) : machine_(machine), reached_(reached), values_(seed, pool_) {}

  void run() {
    if (values_.once_in(2)) begin_with_scene();
    else if (!values_.once_in(4)) begin_with(values_.once_in(30) ? fuzz::pictures : fuzz::openings);
    for (int calls = 3 + values_.below(15); calls > 0; --calls) call_something();
  }

 private:
  // Runs "V[n] = try(…)" and notes what it made.
  void make(const std::string& expression) {
    const std::string name = text("V[", ++made_, "]");
    // Or in a coroutine, where functions given may yield.
    const bool inside = values_.once_in(8);
    machine_.run(text(name, " = try(function() return ", inside ? "odd.inside(function() return " : "", expression, inside ? " end)" : "", " end)"));
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

  void begin_with(const std::vector<fuzz::Opening>& some) {
    for (const auto& expression : some[static_cast<std::size_t>(values_.below(static_cast<int>(some.size())))]) {
      make(expression);
      if (failed()) ++reached_.opened[expression];
    }
  }

  bool failed() {
    lua_State* L = machine_.state();
    const bool is = lua_getglobal(L, "failed") == LUA_TBOOLEAN && lua_toboolean(L, -1);
    lua_pop(L, 1);
    return is;
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
    reached_.called[one.name] += !failed();
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
  const auto programs = static_cast<unsigned>(count > 1 ? std::atoll(words[1]) : 300);
  const auto first = static_cast<unsigned>(count > 2 ? std::atoll(words[2]) : 1);
  Machine machine(count > 3 ? words[3] : ".");
  const Stopwatch clock;
  double before = 0;
  Reached reached;
  unsigned seed = first;
  for (; seed < first + programs; ++seed) {
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
  for (const auto& [expression, times] : reached.opened) machine.say(text("refused ", times, " times: ", expression));
  machine.say("called, but always refused: " + (never.empty() ? "none" : never));
  machine.say(text(machine.executions(), " executions of ", seed - first, " programs (seeds ", first, " to ", seed - 1, ") in ", clock.seconds(), " s, ",
                   machine.failures(), " failures, ", machine.slowest(), "; memory ", fuzz::resident(), " MB", before > 0 ? text(", after 400 programs ", before, " MB") : ""));
  return machine.failures() > 0;
}

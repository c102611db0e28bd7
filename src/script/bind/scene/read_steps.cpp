#include "script/bind/scene/read_steps.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "script/help/nearest.hpp"
#include "script/bind/scene/space.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {
namespace {

/// Calls read() for every entry of the table at index, its key at -2 and its value at -1.
template <class Read>
void for_each_entry(lua_State* L, int index, Read&& read) {
  lua_pushnil(L);
  while (lua_next(L, index)) {
    read();
    lua_pop(L, 1);
  }
}

void require_case(const scene::Scene& scene, const std::string& name) {
  const auto known = load_cases(scene);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near = nearest(name, known);
  if (!near.empty()) throw InputError(text("'load': no load case '", name, "', did you mean '", near, "'?"));
}

/// load = factor, or load = { case = factor, … }.
void read_load(const Arguments& given, const scene::Scene& scene, scene::Step& step) {
  lua_State* L = given.state();
  const int at = given.slot("load");
  if (lua_type(L, at) == LUA_TNUMBER) {
    step.all = lua_tonumber(L, at);
    return;
  }
  for_each_entry(L, at, [&] {
    if (lua_type(L, -2) != LUA_TSTRING)
      throw InputError("'load' must be a factor, or a table of factors by the names of load cases: { shear = 0.5 }");
    const std::string name = lua_tostring(L, -2);
    if (lua_type(L, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(L, -1)))
      throw InputError(text("'load': the factor of '", name, "' must be a finite number"));
    require_case(scene, name);
    step.factor[name] = lua_tonumber(L, -1);
  });
}

/// move = { [contact] = { dx, dy }, … }.
void read_move(const Arguments& given, const scene::Scene& scene, scene::Step& step) {
  lua_State* L = given.state();
  for_each_entry(L, given.slot("move"), [&] {
    if (!object_at(L, -2, Wrapped<scene::Contact>::name))
      throw InputError("'move' must be a table of displacements by contact: { [contact] = { 0.1, 0 } }");
    std::vector<double> by;
    const int value = lua_gettop(L);
    bool numbers = lua_type(L, value) == LUA_TTABLE;
    for (lua_Integer i = 1; numbers && i <= static_cast<lua_Integer>(lua_rawlen(L, value)); ++i) {
      lua_rawgeti(L, value, i);
      numbers = lua_type(L, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L, -1));
      by.push_back(lua_tonumber(L, -1));
      lua_pop(L, 1);
    }
    if (!numbers || static_cast<int>(by.size()) != scene.dimension())
      throw InputError(text("'move': the displacement of a contact's rigid shape must be a table of ",
                            scene.dimension(), " finite numbers"));
    step.move.emplace_back(object<scene::Contact>(L, value - 1), point_of(by));
  });
}

}  // namespace

Key steps_key() {
  return key::list(
      "steps",
      key::table("",
                 {key::either("load", {key::number("", ""), key::any("", "")},
                              "a factor on every load and prescribed displacement, or factors by load case, "
                              "{ shear = 0.5 } (part:load({ 4, 0 }, \"shear\")); those of the step before, at first 1, stay "
                              "where none is given"),
                  key::any("move", "displacements of rigid shapes by contact, { [contact] = { 0.1, 0 } }, from where they "
                           "were at rest and small: normals stay; those of the step before stay where none is given")},
                 ""),
      "a quasi-static history: tables with load and move, one a step");
}

std::vector<scene::Step> read_steps(const Arguments& options, const scene::Scene& scene) {
  std::vector<scene::Step> steps;
  for (const Arguments& given : options.tables("steps")) {
    scene::Step step;
    try {
      for (const char* key : {"load", "move"})
        if (given.has(key) && !given.is(key, LUA_TTABLE) && !(key[0] == 'l' && given.is(key, LUA_TNUMBER)))
          throw InputError(text("'", key, "' must be a table", key[0] == 'l' ? " or a number" : ""));
      if (given.has("load")) read_load(given, scene, step);
      if (given.has("move")) read_move(given, scene, step);
    } catch (const InputError& error) {
      throw InputError(text("step ", steps.size() + 1, ": ", error.what()));
    }
    steps.push_back(std::move(step));
  }
  if (steps.empty()) throw InputError("'steps' is empty; give at least one step, {} for all loads at once");
  return steps;
}

}  // namespace dotyk::script

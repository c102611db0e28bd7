#include "script/bind/setups.hpp"

namespace dotyk::script::setup {

std::string mesh() { return "local m = dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {16,8} }\n"; }

std::string block() {
  return mesh() + "local block = dotyk.body{ name = \"block\", mesh = m, material = dotyk.material{ E = 1000, nu = 0.3 } }\n";
}

std::string pressed_block(const std::string& more) {
  return block() +
         "block:part \"left\":fix \"x\"\nblock:part \"top\":load{ 0, -10 }\nlocal scene = dotyk.scene{ block }\n"
         "local base = dotyk.rigid.ball{ center = {0,-25}, radius = 25 }\n"
         "local contact = scene:contact{ block:part \"bottom\", rigid = base" +
         more + " }\n";
}

std::string solved_block() { return pressed_block() + "local s = dotyk.solve(scene)\n"; }

std::string supported_block() {
  return block() +
         "block:part \"left\":fix \"x\"\nblock:part \"top\":load{ 0, -10 }\n"
         "block:part \"bottom\":support{ normal = dotyk.law.one_sided_elastic(1e3) }\n"
         "local s = dotyk.solve(dotyk.scene{ block })\n";
}

std::string few_nodes() {
  return "local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {1,1} }\n"
         "local block = dotyk.body{ mesh = m, material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
         "block:part \"top\":displace{ x = 0.02, y = -0.02 }\n"
         "local scene = dotyk.scene{ block }\n"
         "scene:contact{ block:part \"bottom\", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} },\n"
         "  friction = dotyk.friction.coulomb(0.3) }\n";
}

std::string two_blocks() {
  return "local steel = dotyk.material{ E = 210e3, nu = 0.3 }\n"
         "local below = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {16,8} }\n"
         "local above = dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {16,8} }\n"
         "local lower = dotyk.body{ name = \"lower\", mesh = below, material = steel }\n"
         "local upper = dotyk.body{ name = \"upper\", mesh = above, material = steel }\n"
         "lower:part \"bottom\":fix()\nupper:part \"top\":displace{ x = 0, y = -0.001 }\n"
         "local scene = dotyk.scene{ lower, upper }\n";
}

std::string contact_problem() {
  return "io.open(\"one.dat\", \"w\"):write[[\n"
         "2 1  0 2 2  2 2\n"
         "2 0  0 1\n"
         "-1 1\n"
         "0.3\n"
         "]]:close() -- dimension, contacts, sizes; W, q and mu\n"
         "local p = dotyk.fclib \"one.dat\"\n";
}

std::string solved_beam() {
  return "local stop = dotyk.law.signorini()\n"
         "local b = dotyk.beam{ length = 1, EJ = 1, load = -1, left = { deflection = stop }, right = { deflection = stop },\n"
         "  supports = { { x = 0.5, deflection = dotyk.law.elastic(100) } } }\n"
         "local s = dotyk.solve(b)\n";
}

std::string solved_plate() {
  return "local function plate(cells)\n"
         "  local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {cells,cells} }\n"
         "  return dotyk.plate{ mesh = m, load = -1, edge = { deflection = dotyk.law.signorini() } }\n"
         "end\n"
         "local s = dotyk.solve(plate(12))\n";
}

std::string shape() {
  return pressed_block() +
         "local shape = dotyk.shape{ scene = scene, objective = \"peak_pressure\",\n"
         "  moves = { { part = block:part \"bottom\", control_points = 5, direction = {0,1}, lower = 0, upper = 0.05 } } }\n";
}

}  // namespace dotyk::script::setup

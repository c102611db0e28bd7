#pragma once
// Lua that makes what examples start from, so that each runs as help shows it. Every line ends in a line break.
#include <string>

namespace dotyk::script::setup {

// m, a mesh of triangles, 2 x 1.
inline std::string mesh() { return "local m = dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {16,8} }\n"; }

// and block, an elastic body of it.
inline std::string block() {
  return mesh() + "local block = dotyk.body{ name = \"block\", mesh = m, material = dotyk.material{ E = 1000, nu = 0.3 } }\n";
}

// and scene: the block pressed on a slightly round base, which it leaves at its ends; contact, with what else is said of it (", friction = …").
inline std::string pressed_block(const std::string& more = "") {
  return block() +
         "block:part \"left\":fix \"x\"\nblock:part \"top\":load{ 0, -10 }\nlocal scene = dotyk.scene{ block }\n"
         "local base = dotyk.rigid.ball{ center = {0,-25}, radius = 25 }\n"
         "local contact = scene:contact{ block:part \"bottom\", rigid = base" +
         more + " }\n";
}

// and s, the solution.
inline std::string solved_block() { return pressed_block() + "local s = dotyk.solve(scene)\n"; }

// scene: two triangles pressed and pushed on a rigid base with friction, two contact nodes.
inline std::string few_nodes() {
  return "local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {1,1} }\n"
         "local block = dotyk.body{ mesh = m, material = dotyk.material{ E = 1000, nu = 0.3 } }\n"
         "block:part \"top\":displace{ x = 0.02, y = -0.02 }\n"
         "local scene = dotyk.scene{ block }\n"
         "scene:contact{ block:part \"bottom\", rigid = dotyk.rigid.plane{ point = {0,0}, normal = {0,1} },\n"
         "  friction = dotyk.friction.coulomb(0.3) }\n";
}

// block, on a support by laws; s, the solution.
inline std::string supported_block() {
  return block() +
         "block:part \"left\":fix \"x\"\nblock:part \"top\":load{ 0, -10 }\n"
         "block:part \"bottom\":support{ normal = dotyk.law.one_sided_elastic(1e3) }\n"
         "local s = dotyk.solve(dotyk.scene{ block })\n";
}

// lower and upper, one block on another, pressed together by a displacement; scene has no contact yet.
inline std::string two_blocks() {
  return "local steel = dotyk.material{ E = 210e3, nu = 0.3 }\n"
         "local below = dotyk.mesh.rectangle{ from = {-1,-1}, to = {1,0}, cells = {16,8} }\n"
         "local above = dotyk.mesh.rectangle{ from = {-1,0}, to = {1,1}, cells = {16,8} }\n"
         "local lower = dotyk.body{ name = \"lower\", mesh = below, material = steel }\n"
         "local upper = dotyk.body{ name = \"upper\", mesh = above, material = steel }\n"
         "lower:part \"bottom\":fix()\nupper:part \"top\":displace{ x = 0, y = -0.001 }\n"
         "local scene = dotyk.scene{ lower, upper }\n";
}

// p, a problem of one contact between u = Wr + q and r, from a file written first.
inline std::string contact_problem() {
  return "io.open(\"one.dat\", \"w\"):write[[\n"
         "2 1  0 2 2  2 2\n"
         "2 0  0 1\n"
         "-1 1\n"
         "0.3\n"
         "]]:close() -- dimension, contacts, sizes; W, q and mu\n"
         "local p = dotyk.fclib \"one.dat\"\n";
}

// b, a beam on three supports; s, its solution.
inline std::string solved_beam() {
  return "local stop = dotyk.law.signorini()\n"
         "local b = dotyk.beam{ length = 1, EJ = 1, load = -1, left = { deflection = stop }, right = { deflection = stop },\n"
         "  supports = { { x = 0.5, deflection = dotyk.law.elastic(100) } } }\n"
         "local s = dotyk.solve(b)\n";
}

// s, a square plate's solution.
inline std::string solved_plate() {
  return "local function plate(cells)\n"
         "  local m = dotyk.mesh.rectangle{ from = {0,0}, to = {1,1}, cells = {cells,cells} }\n"
         "  return dotyk.plate{ mesh = m, load = -1, edge = { deflection = dotyk.law.signorini() } }\n"
         "end\n"
         "local s = dotyk.solve(plate(12))\n";
}

// pressed_block(), and shape, with five variables.
inline std::string shape() {
  return pressed_block() +
         "local shape = dotyk.shape{ scene = scene, objective = \"peak_pressure\",\n"
         "  moves = { { part = block:part \"bottom\", control_points = 5, direction = {0,1}, lower = 0, upper = 0.05 } } }\n";
}

}  // namespace dotyk::script::setup

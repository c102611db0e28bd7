#pragma once
// Lua that makes what examples start from, so that each runs as help shows it. Every line ends in a line break.
#include <string>

namespace dotyk::script::setup {

// m, a mesh of triangles, 2 x 1.
std::string mesh();

// and block, an elastic body of it.
std::string block();

// and scene: the block pressed on a slightly round base, which it leaves at its ends; contact, with what else is said of it (", friction = …").
std::string pressed_block(const std::string& more = "");

// and s, the solution.
std::string solved_block();

// scene: two triangles pressed and pushed on a rigid base with friction, two contact nodes.
std::string few_nodes();

// block, on a support by laws; s, the solution.
std::string supported_block();

// lower and upper, one block on another, pressed together by a displacement; scene has no contact yet.
std::string two_blocks();

// p, a problem of one contact between u = Wr + q and r, from a file written first.
std::string contact_problem();

// b, a beam on three supports; s, its solution.
std::string solved_beam();

// s, a square plate's solution.
std::string solved_plate();

// pressed_block(), and shape, with five variables.
std::string shape();

}  // namespace dotyk::script::setup

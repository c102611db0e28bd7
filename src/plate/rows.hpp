#pragma once

#include "plate/model.hpp"

namespace dotyk::plate {

/// Adds the rows of the samples, point supports and obstacle to the model's problem. Where parts of the edge meet at a vertex, laws of one
/// kind act there together; a prescribed deflection outweighs all others, Signorini's law friction, which one point more or less
/// does not change. Throws InputError where what is held contradicts a one-sided law or the obstacle.
void add_rows(const Plate& plate, Model& model);

/// Which unknowns some row acts on.
std::vector<char> touched_by_rows(const problem::Problem& problem);

}  // namespace dotyk::plate

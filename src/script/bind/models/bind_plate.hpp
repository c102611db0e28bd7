#pragma once
// Plates for scripts, and for the calls that solve them.
#include "plate/solve.hpp"
#include "script/bridge/call.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {

template <>
struct Wrapped<plate::Model> : Called<"plate"> {};
template <>
struct Wrapped<plate::Solution> : Called<"plate_solution"> {};

// Solves; gives a plate_solution.
int solve_plate(Call& call, const std::shared_ptr<const plate::Model>& plate, const solver::Method& method, std::vector<Function> on_iteration, bool verbose);

// The place in Plate::edges of a part that has laws; throws InputError where there is none of that name.
int find_edge(const plate::Plate& plate, const std::string& part);

}  // namespace dotyk::script

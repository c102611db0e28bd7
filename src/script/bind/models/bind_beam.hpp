#pragma once
// Beams for scripts, and for the calls that solve them.
#include "beam/solve.hpp"
#include "script/bridge/call.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {

// What solving a beam gives: its solution of least energy, and all local minima.
struct BeamResult {
  std::vector<beam::Branch> branches;  // least energy first
  std::size_t shown = 0;               // which of them this is
  const beam::Solution& solution() const { return *branches[shown].solution; }
};

template <>
struct Wrapped<problem::SupportLaw> : Called<"law"> {};
template <>
struct Wrapped<beam::Beam> : Called<"beam"> {};
template <>
struct Wrapped<BeamResult> : Called<"beam_solution"> {};

// A key for a law of dotyk.law; the law given, else free.
Key law_key(const char* name, const char* help);
problem::SupportLaw law(const Arguments& from, const char* name);
// Is the key for where the law `name` stands given? Throws InputError where there is no such law that could be there.
bool stands_somewhere(const Arguments& from, const char* name);
// The keys for the laws of a support, and for where on a beam a value is asked.
inline std::vector<Key> support_law_keys() { return {law_key("deflection", "a law of dotyk.law"), law_key("rotation", "a law of dotyk.law")}; }
inline std::vector<Key> x_key() { return {key::number("x", "from the left end").unit("length").required()}; }

// Solves; gives a beam_solution.
int solve_beam(Call& call, const beam::Beam& beam, const solver::Method& method, std::vector<Function> on_iteration, bool verbose);

// A support told by "left", "right" or its x, and its place in Beam::supports; throws InputError where there is none.
Key support_key(std::string name);
int find_support(const beam::Beam& beam, const Arguments& from, const std::string& name);

}  // namespace dotyk::script

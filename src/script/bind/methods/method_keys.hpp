#pragma once
// What the makers of methods, dotyk.solver.*, share.
#include <optional>
#include <string>
#include <vector>

#include "script/bridge/call.hpp"
#include "script/bridge/descriptor.hpp"
#include "solver/core/method.hpp"

namespace dotyk::script {

class Library;

// Keys that every method takes: tol, max_iterations, ordering, on_iteration, verbose; `own` come first.
std::vector<Key> method_keys(std::vector<Key> own, int max_iterations = 100);
void read_settings(const Call& call, solver::Settings& settings);
// A method with those of its options that every method takes.
template <class Method>
Method settings_of(const Call& call) {
  Method method;
  read_settings(call, method);
  return method;
}
// `own`, and the keys kernel and screws: how rigid motions of free bodies are treated.
std::vector<Key> with_kernel(std::vector<Key> own);
// The rows where screws are placed first, from 0, empty where they are chosen; nothing where the kernel is exact. Added to `shown`.
std::optional<std::vector<int>> screws_of(const Call& call, std::string& shown);
// The solver object: `text` is its name and options as printed.
int give_method(Call& call, solver::Method method, std::string text);

void bind_methods(Library& library);
void bind_friction_methods(Library& library);
void bind_feti(Library& library);
void bind_program_methods(Library& library);

}  // namespace dotyk::script

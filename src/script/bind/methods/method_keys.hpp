#pragma once
// What the makers of methods, dotyk.solver.*, share.
#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "script/bind/setups.hpp"
#include "script/bridge/bound.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/wrapped.hpp"
#include "solver/core/method.hpp"
#include "solver/active/screws.hpp"

namespace dotyk::script {

// Keys that every method takes: tol, max_iterations, ordering, on_iteration, verbose; `own` come first.
std::vector<Key> method_keys(std::vector<Key> own, int max_iterations);
// `own`, and the keys kernel and screws: how rigid motions of free bodies are treated.
std::vector<Key> with_kernel(std::vector<Key> own);
// The rows where screws are placed first, from 0, empty where they are chosen; nothing where the kernel is exact. Added to `shown`.
std::optional<std::vector<int>> screws_of(const Call& call, std::string& shown);
// The solver object: `text` is its name and options as printed.
Given<Solver> give_method(Call& call, solver::Method method, std::string text);

// The maker of a method: `own` are its keys, into its members, and own options are shown as show(method, call) says, which may set more of them. With
// `kernel`, magnetic screws may hold free bodies. Examples begin with setup::pressed_block(), unless `about` says otherwise.
template <class Method, class Show>
void add_method(Library& library, Descriptor about, std::vector<Key> own, int max_iterations, Show show, bool kernel = false) {
  about.arguments = {key::table(method_keys(kernel ? with_kernel(std::move(own)) : std::move(own), max_iterations))};
  if (about.setup.empty()) about.setup = setup::pressed_block();
  about.run = [name = about.short_name(), show, kernel](Call& call) {
    Method method;
    call.fill<solver::Settings>(method);
    call.fill(method);
    method.max_iterations = std::min(method.max_iterations, 1'000'000);
    const std::string options = show(method, call);
    std::string shown = name + (options.empty() ? "" : ": " + options);
    auto screws = kernel ? screws_of(call, shown) : std::nullopt;
    if constexpr (requires { method.kernel; }) {
      if (screws) method.kernel = Method::Kernel::screws, method.screws = std::move(*screws);
    } else if constexpr (std::derived_from<Method, solver::RowMethod>) {
      if (screws) {
        solver::WithScrews held(std::make_shared<const Method>(std::move(method)));
        held.screws = std::move(*screws);
        return give_method(call, std::move(held), std::move(shown));
      }
    }
    return give_method(call, std::move(method), std::move(shown));
  };
  library.function(std::move(about));
}

void bind_methods(Library& library);
void bind_friction_methods(Library& library);
void bind_feti(Library& library);

}  // namespace dotyk::script

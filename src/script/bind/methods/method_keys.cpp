#include "script/bind/methods/method_keys.hpp"

#include "script/bind/bind.hpp"

namespace dotyk::script {

std::string Solver::text() const { return own + dotyk::text(", tol = ", tol) + common; }

using algebra::Ordering;

std::vector<Key> method_keys(std::vector<Key> own, int max_iterations) {
  const std::vector<Key> common = {
      key::positive("tol", "relative natural residual at which iterative methods stop").into(&solver::Settings::tol),
      key::integer("max_iterations", "give up after so many").at_least(1).fallback(static_cast<double>(max_iterations)).into(&solver::Settings::max_iterations),
      key::choice<Ordering>("ordering", {{"automatic", Ordering::automatic}, {"minimum_degree", Ordering::minimum_degree},
                                         {"nested_dissection", Ordering::nested_dissection}},
                            "elimination order of the sparse factorisation").into(&solver::Settings::ordering),
      key::function("on_iteration", "called as f(k, info) after each iteration; returning false stops the solve"),
      key::boolean("verbose", "a line on standard error for each iteration").fallback(false)};
  return joined(std::move(own), common);
}

std::vector<Key> with_kernel(std::vector<Key> own) {
  own.push_back(key::choice("kernel", {"exact", "screws"}, "rigid motions of free bodies: exactly, as constraints of the "
                            "dual problem, or by magnetic screws (contact nodes taken as closed, with given friction also as stuck; moved where they pull, "
                            "or bear more than friction can)").fallback("exact"));
  own.push_back(key::list("screws", key::integer("", "").at_least(1), "rows (contact nodes, in order; then those of friction) where the screws "
                          "are placed first").otherwise("chosen by the load's equilibrium"));
  return own;
}

std::optional<std::vector<int>> screws_of(const Call& call, std::string& shown) {
  if (call.text("kernel") == "exact") return {};
  shown += ", kernel by screws";
  std::vector<int> rows;
  if (call.has("screws"))
    for (const long long row : call.integers("screws")) rows.push_back(static_cast<int>(row - 1));
  for (std::size_t k = 0; k < rows.size(); ++k) shown += dotyk::text(k == 0 ? " first at rows " : ", ", rows[k] + 1);
  return rows;
}

Given<Solver> give_method(Call& call, solver::Method method, std::string text) {
  std::string common = dotyk::text(", max_iterations = ", call.integer("max_iterations"));
  if (call.choice<Ordering>("ordering") != Ordering::automatic) common += ", ordering = " + call.text("ordering");
  auto made = std::make_shared<Solver>(
      Solver{std::move(method), "solver " + std::move(text), call.number("tol"), std::move(common), call.boolean("verbose")});
  return call.give_keeping(made, {"on_iteration"});
}

}  // namespace dotyk::script

#include "scene/study/repeated.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {

template <> struct Wrapped<scene::RepeatedSolution> : Called<"repeated_systems"> {};

namespace {

using algebra::RepeatedSettings;
using scene::RepeatedSolution;

RepeatedSettings settings(const Call& call) {
  const auto s = call.filled<RepeatedSettings>();
  const auto only = [&](const char* key, const char* owner, bool used) {
    if (call.has(key) && !used) throw InputError(text("'", key, "' belongs to ", owner, ", not to method = \"", call.text("method"), "\""));
  };
  only("extend", "method = \"scg\"", s.method == RepeatedSettings::Method::scg);
  only("deflate", "method = \"cglan\"", s.method == RepeatedSettings::Method::cglan);
  only("omega", "preconditioner = \"ssor\"", s.preconditioning == algebra::Preconditioning::ssor);
  return s;
}

std::vector<std::vector<double>> velocities(const Call& call, const scene::Scene& scene) {
  lua_State* L = call.state();
  int k = 0;
  return read_list(L, call.slot("velocities"), [&](int at) {
    const Function function(L, at, text("velocities[", ++k, "]"), "repeated_systems");
    return at_nodes(Field(function, static_cast<std::size_t>(scene.dimension())), *scene.bodies.front()->mesh);
  });
}

std::shared_ptr<RepeatedSolution> solve_repeated_systems(Call& call) {
  const auto scene = call.object<scene::Scene>("scene");
  if (call.has("loads") == call.has("velocities"))
    throw InputError("give either loads, names of load cases, or velocities, functions by which design variables move the nodes");
  const RepeatedSettings chosen = settings(call);
  const auto moves = call.has("velocities") ? velocities(call, *scene) : std::vector<std::vector<double>>();
  Watch watch(call.state(), "solving");
  const auto solution = std::make_shared<RepeatedSolution>(
      call.has("loads") ? scene::solve_load_cases(*scene, call.texts("loads"), chosen, watch)
                        : scene::solve_sensitivities(*scene, moves, chosen, watch));
  watch.answer();
  return solution;
}

std::vector<Record> systems(const RepeatedSolution& s) {
  std::vector<Record> all;
  for (std::size_t k = 0; k < s.systems.size(); ++k) {
    const auto& one = s.systems[k];
    all.push_back({"system", {{"name", s.names[k]}, {"iterations", one.iterations}, {"seconds", one.seconds}, {"residual", one.residual},
                              {"converged", one.converged}, {"reason", one.reason}, {"energy", s.energies[k]}}});
  }
  return all;
}

int nodes(Call& call) {
  const auto s = call.self<RepeatedSolution>();
  const auto count = static_cast<long long>(s->solutions.size()), system = call.integer("system");
  if (system < 1 || system > count) throw InputError(text("system ", system, " is not one of 1 to ", count));
  const auto dimension = static_cast<std::size_t>(s->mesh->dimension());
  std::vector<std::vector<double>> rows;
  for (int n = 0; n < s->mesh->node_count(); ++n) {
    rows.emplace_back(s->mesh->node(n), s->mesh->node(n) + dimension);
    const double* u = &s->solutions[static_cast<std::size_t>(system - 1)][static_cast<std::size_t>(n) * dimension];
    rows.back().insert(rows.back().end(), u, u + dimension);
  }
  return call.give(rows);
}

std::vector<Key> repeated_systems_keys() {
  using S = RepeatedSettings;
  using Method = S::Method;
  using algebra::Preconditioning;
  return {key::object<scene::Scene>("scene", "one body that its supports hold").required(),
          key::list("loads", key::string("", ""), "names of load cases: one system each").count(1, 4096).otherwise("velocities are given"),
          key::list("velocities", key::function("", ""),
                    "functions of the coordinates to the velocity of a node (as many numbers as the body has dimensions) when a design "
                    "variable grows: the displacement and its derivatives").count(1, 4096).unit("length per unit of the variable").otherwise("loads are given"),
          key::choice<Method>("method", {{"cholesky", Method::cholesky}, {"cg", Method::cg}, {"scg", Method::scg}, {"cglan", Method::cglan}, {"block_cg", Method::block_cg}},
                               "cholesky: direct, all at once. cg: conjugate gradients, each alone. scg: successive cg, starts from the conjugate "
                               "directions of the first system. cglan: starts from its lowest Lanczos eigenvectors. block_cg: all right-hand "
                               "sides at once").into(&S::method),
          key::choice<Preconditioning>("preconditioner", {{"none", Preconditioning::none}, {"ssor", Preconditioning::ssor}, {"ic", Preconditioning::incomplete_cholesky}},
                                        "ssor by Eisenstat's trick; ic: incomplete Cholesky on the pattern of K").into(&S::preconditioning),
          key::number("omega", "relaxation of ssor").above(0).below(2).into(&S::omega),
          key::positive("tol", "of |b - Kx|/|b|").below(1).into<S>([](S& s) -> double& { return s.cg.tolerance; }),
          key::integer("max_iterations", "for one system").within(1, 1 << 30).otherwise("ten times the unknowns").into<S>([](S& s) -> int& { return s.cg.most; }),
          key::boolean("extend", "scg: later systems add their directions").into(&S::extend),
          key::boolean("deflate", "cglan: the iterations, too, stay conjugate to the eigenvectors").into(&S::deflate)};
}

}  // namespace

void bind_repeated(Library& library) {
  library.function(
      {.name = "dotyk.repeated_systems",
       .help = "Solves many linear systems K x = b with the stiffness K of one body: its load cases, or its displacement u and the "
               "derivatives of u by design variables that move the nodes, K du/da = df/da - (dK/da) u, both exact: loads, given per area or "
               "volume, and springs stay with their points, tractions keep their directions, pressures follow the normal, prescribed "
               "displacements stay. Compares the ways to profit from earlier systems: time and iterations of each.",
       .example = "local m = dotyk.mesh.box{ from = {0,0,0}, to = {8,1,1}, cells = {16,2,2}, element = \"Q1\" }\n"
                  "local beam = dotyk.body{ name = \"beam\", mesh = m, material = dotyk.material{ E = 1, nu = 0.3 } }\n"
                  "beam:part \"left\":fix()\nbeam:part \"right\":load{ 0, 0, -1e-4 }\n"
                  "local r = dotyk.repeated_systems{ scene = dotyk.scene{ beam }, method = \"scg\",\n"
                  "  velocities = { function(x, y, z) return 0, 0, (z - 0.5) * (1 - x/8) end } }\n"
                  "for _, s in ipairs(r.systems) do print(s.name, s.iterations, s.seconds) end",
       .arguments = {key::table(repeated_systems_keys())},
       .run = solve_repeated_systems});
  library.type<RepeatedSolution>("Solutions of systems with one stiffness.")
      .field("systems", "of each system, in order: name, iterations (0 of cholesky), seconds (an equal share where several are solved "
                        "at once), residual |b - Kx|/|b|, converged, reason, energy x'b", systems)
      .field("converged", "have all?", [](const RepeatedSolution& s) { return s.converged(); })
      .field("unknowns", "of each system", &RepeatedSolution::unknowns)
      .field("setup_seconds", "of the factor or the preconditioner", &RepeatedSolution::setup_seconds, "s")
      .field("bytes", "of the factor, or of the preconditioner and the vectors kept; at their greatest", &RepeatedSolution::bytes)
      .field("kept", "vectors kept for a next system", &RepeatedSolution::kept)
      .method({.name = "repeated_systems:nodes",
               .help = "The solution of one system: for every node its coordinates and its displacement, or the displacement's derivative.",
               .setup = setup::block() + "block:part \"bottom\":fix()\n"
                        "block:part \"left\":load({ 1, 0 }, \"wind\")\nblock:part \"top\":load({ 0, -1 }, \"snow\")\n",
               .example = "local r = dotyk.repeated_systems{ scene = dotyk.scene{ block }, loads = { \"wind\", \"snow\" } }\n"
                          "local corner = r:nodes(1)[153]\nprint(table.unpack(corner))",
               .arguments = {key::integer("system", "its number, from 1").required()},
               .run = nodes})
      .text([](const RepeatedSolution& s) {
        long iterations = 0;
        for (const auto& one : s.systems) iterations += one.iterations;
        return text("repeated_systems: ", s.systems.size(), " systems of ", s.unknowns, " unknowns, ", iterations, " iterations",
                    s.converged() ? "" : ", not all converged");
      });
}

}  // namespace dotyk::script

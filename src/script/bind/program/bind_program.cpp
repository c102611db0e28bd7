#include <map>

#include "program/active_set.hpp"
#include "program/augmented_lagrangian.hpp"
#include "program/certificate.hpp"
#include "program/interior_point.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/program/program_input.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using program::AugmentedLagrangian;
using program::QuadraticProgram;

const std::vector<std::string> kProgramMethods = {"active_set", "interior_point", "multiplier", "least_squares"};

std::vector<Key> solve_keys() {
  using L = AugmentedLagrangian;
  using program::ActiveSet, program::InteriorPoint;
  using Change = ActiveSet::Change;
  using Start = ActiveSet::Start;
  return {key::choice("method", kProgramMethods, "active_set: exact, P semidefinite allowed; interior_point; multiplier and "
                                          "least_squares: augmented Lagrangians for equalities, named by the update")
              .otherwise("\"active_set\""),
          key::choice<Change>("change", {{"one", Change::one}, {"many", Change::many}}, "active_set: rows that change in one step").into(&ActiveSet::change),
          key::choice<Start>("start", {{"automatic", Start::automatic}, {"cold", Start::cold}, {"interior_point", Start::interior_point}},
                             "active_set: its first working set; automatic: cold up to 200 unknowns and rows").into(&ActiveSet::start),
          key::positive("tol", "active_set and interior_point: on residuals, in the scaled program").into(&ActiveSet::tol).into(&InteriorPoint::tol),
          key::integer("max_iterations", "give up after so many").at_least(1)
              .otherwise("20000 (active_set), 200 (others)").into(&ActiveSet::max_iterations).into(&InteriorPoint::max_iterations).into(&L::max_iterations),
          key::positive("M", "augmented Lagrangians: inner precision, |gradient| <= M |Dx - d|").into(&L::M),
          key::positive("rho", "first penalty; as M for B and c divided by their greatest entry, where that is beyond 1e6 or below 1e-6").into(&L::rho),
          key::number("alpha", "factor on eta when |Dx - d| <= eta").within(0, 1).into(&L::alpha),
          key::number("beta", "factor on the penalty otherwise").above(1).into(&L::beta),
          key::positive("eta", "first bound on |Dx - d|").into(&L::eta),
          key::positive("gradient_tol", "augmented Lagrangians stop at |gradient| <= this |c|").into(&L::gradient_tol),
          key::positive("feasibility_tol", "and at |Dx - d| <= this").into(&L::feasibility_tol),
          key::function("on_iteration", "called as f(k, info) after each iteration; returning false stops the solve"),
          key::boolean("verbose", "a line on standard error for each iteration").fallback(false)};
}

/// With settings of this type, as they are given.
template <class Settings>
program::Result run_with(const QuadraticProgram& p, const Arguments& given, Monitor& watch, Settings settings = {}) {
  given.fill(settings);
  settings.max_iterations = std::min(settings.max_iterations, 100'000'000);
  return program::solve(p, settings, watch);
}

program::Result run_method(const QuadraticProgram& p, const Arguments& given, const std::string& method, Monitor& watch) {
  using Update = AugmentedLagrangian::Update;
  if (method == "active_set") return run_with<program::ActiveSet>(p, given, watch);
  if (method == "interior_point") return run_with<program::InteriorPoint>(p, given, watch);
  return run_with<AugmentedLagrangian>(p, given, watch, {.update = method == "multiplier" ? Update::multiplier : Update::least_squares});
}

std::shared_ptr<ProgramResult> solve_with(Call& call, const std::shared_ptr<QuadraticProgram>& p) {
  std::vector<Function> on_iteration;
  if (call.has("on_iteration")) on_iteration.push_back(call.function("on_iteration"));
  Watch watch(call.state(), "solving", on_iteration, call.boolean("verbose"));
  auto result = std::make_shared<ProgramResult>();
  result->program = p;
  result->method = call.has("method") ? call.text("method") : kProgramMethods.front();
  result->result = run_method(*p, call, result->method, watch);
  watch.answer();
  return result;
}

int make_program(Call& call) {
  std::optional<Watch> watch(std::in_place, call.state(), "reading");
  const auto p = read_program(call, *watch);
  watch.reset();  // the solve has one of its own
  return call.has("method") ? call.give(solve_with(call, p)) : call.give(p);
}

int bounds(const QuadraticProgram& p) {
  int count = 0;
  for (int r = 0; r < p.rows(); ++r) count += p.A.row(r).nonZeros() == 1;
  return count;
}

int equalities(const QuadraticProgram& p) {
  int count = 0;
  for (int r = 0; r < p.rows(); ++r) count += p.equality(r);
  return count;
}

std::vector<std::string> working(const ProgramResult& r) {
  using program::Side;
  static const std::map<Side, const char*> names = {{Side::low, "low"}, {Side::free, "free"}, {Side::high, "high"}, {Side::equal, "equal"},
                                                    {Side::above, "above"}, {Side::below, "below"}};
  std::vector<std::string> out;
  for (const Side side : r.result.working) out.emplace_back(names.at(side));
  return out;
}

Record program_residual_record(const ProgramResult& result) {
  const program::Residuals& r = result.result.residual;
  return {"residual", {{"stationarity", r.stationarity}, {"feasibility", r.feasibility}, {"complementarity", r.complementarity},
                       {"stationarity_scale", r.stationarity_scale}, {"feasibility_scale", r.feasibility_scale},
                       {"complementarity_scale", r.complementarity_scale}}};
}

Record bracket_record(const ProgramResult& r) {
  const program::Bracket b = r.result.x.size() && r.result.y.size() == r.program->rows()
                                 ? program::bracket(*r.program, r.result.x, r.result.y)
                                 : program::Bracket{0, -INFINITY, INFINITY, 0, 0};
  return {"bracket", {{"primal", b.primal}, {"dual", b.dual}, {"gap", b.gap}, {"violation", b.violation}, {"slack", b.slack}}};
}

std::string program_result_text(const ProgramResult& r) {
  const program::Result& s = r.result;
  return text("program_result (", r.method, "): ", program::text_of(s.status), ", ", s.reason, "\n  objective ",
              s.objective, ", ", s.iterations, " iterations, residuals: stationarity ", s.residual.stationarity,
              ", feasibility ", s.residual.feasibility, ", complementarity ", s.residual.complementarity);
}

using program::Lcp;
using program::LcpResult;
using program::LcpSettings;

Lcp given_lcp(const Call& call) {
  if (call.has("file")) {
    if (call.has("M") || call.has("q")) throw InputError("give either a file, or M and q");
    return program::read_lcp(call.text("file"));
  }
  if (!call.has("M") || !call.has("q")) throw InputError("M and q are needed, or a file");
  Lcp lcp;
  lcp.q = vector_of(call.vector("q"));
  lcp.M = square_matrix(call, "M", lcp.size(), "q");
  return lcp;
}

std::shared_ptr<LcpResult> solve_lcp(Call& call) {
  const Lcp lcp = given_lcp(call);
  auto settings = call.filled<LcpSettings>();
  if (call.has("start")) {
    settings.start.assign(lcp.size(), 0);
    for (const long long i : call.integers("start")) {
      if (i < 1 || i > lcp.size()) throw InputError(text("start names unknown ", i, "; there are ", lcp.size()));
      settings.start[i - 1] = 1;
    }
  }
  Watch watch(call.state(), "solving");
  const auto result = std::make_shared<LcpResult>(program::solve(lcp, settings, watch));
  watch.answer();
  return result;
}

std::vector<std::vector<int>> cycle(const LcpResult& r) {
  std::vector<std::vector<int>> out;
  for (const auto& set : r.cycle) {
    out.emplace_back();
    for (std::size_t i = 0; i < set.size(); ++i)
      if (set[i]) out.back().push_back(static_cast<int>(i) + 1);
  }
  return out;
}

void bind_lcp(Library& library) {
  using Method = LcpSettings::Method;
  library.function(
      {.name = "dotyk.lcp",
       .help = "Solves a linear complementarity problem w = Mz + q >= 0, z >= 0, z'w = 0, M not necessarily "
               "symmetric, and sparse where it is large. The active-set method (newton_min) is tried first; where it goes "
               "round in circles, or meets a singular matrix, Lemke's method; up to 16 unknowns enumeration says whether there "
               "is no solution, or more than one.",
       .example = "local r = dotyk.lcp{ M = {{1, 0, 2}, {2, 1, 0}, {0, 2, 1}}, q = {1, 1, 1}, start = {1} }\n"
                  "print(r.status, #r.cycle, r.method)\nio.open(\"two.dat\", \"w\"):write \"2  0 2 2 2 2  2 1  1 2  -1 -1\":close()\nprint(dotyk.lcp \"two.dat\")",
       .arguments = {key::table(
           {key::file("file", "a file in the text format of siconos, instead of M and q").otherwise("none"),
            matrix_key("M", "n x n"), key::vector("q", "n"),
            key::choice<Method>("method", {{"automatic", Method::automatic}, {"newton_min", Method::newton_min}, {"lemke", Method::lemke},
                                           {"enumeration", Method::enumeration}}, "one method alone, or one after the other").into(&LcpSettings::method),
            key::list("start", key::integer("", ""), "unknowns that are free (w = 0) in newton_min's first set").otherwise("none"),
            key::boolean("unique", "up to 16 unknowns: look for further solutions").into(&LcpSettings::unique)})},
       .run = solve_lcp});
  library.type<LcpResult>("The result of a linear complementarity problem.")
      .field("status", "\"solved\", \"several\" (more than one solution), \"none\" (there is no solution) or \"stopped\"",
             [](const LcpResult& r) { return program::text_of(r.status); })
      .field("reason", "how it ended, in words", &LcpResult::reason)
      .field("method", "the method that found z", &LcpResult::method)
      .field("z", "the solution", [](const LcpResult& r) { return list(r.z); })
      .field("w", "Mz + q", [](const LcpResult& r) { return list(r.w); })
      .field("other", "a second solution; empty where none is known", [](const LcpResult& r) { return list(r.other); })
      .field("cycle", "the sets of free unknowns among which newton_min went round, in order; empty where it did not", cycle)
      .field("solves", "linear systems newton_min solved", &LcpResult::solves)
      .field("pivots", "of Lemke's method", &LcpResult::pivots)
      .field("counted", "was it decided whether there are further solutions?", &LcpResult::counted)
      .field("residual", "largest min(z, w), relative row by row", &LcpResult::residual)
      .field("seconds", "time taken", &LcpResult::seconds, "s")
      .text([](const LcpResult& r) { return text("lcp_result: ", program::text_of(r.status), ", ", r.reason); });
}

}  // namespace

void bind_program(Library& library) {
  library.function(
      {.name = "dotyk.qp",
       .help = "A convex quadratic program: minimise 1/2 x'Bx - c'x subject to Dx = d, low <= Ax <= high and "
               "x_low <= x <= x_high; or one from a file, dotyk.qp \"name.qps\". Returns the program, to be solved by "
               "its method solve; with the key method, solves at once and returns the result.",
       .example = "local r = dotyk.qp{ B = {{2, 0}, {0, 2}}, c = {2, 5}, D = {{1, 1}}, d = {1}, x_low = 0, method = "
                  "\"active_set\" }\nprint(r)\nio.open(\"small.qps\", \"w\"):write(\n"
                  "  \"NAME small\\nROWS\\n N cost\\n G sum\\nCOLUMNS\\n x cost 1 sum 1\\n y cost 2 sum 1\\n\",\n"
                  "  \"RHS\\n rhs sum 1\\nQUADOBJ\\n x x 2\\n y y 2\\nENDATA\\n\"):close()\nprint(dotyk.qp \"small.qps\":solve{ change = \"many\" })",
       .arguments = {key::table(joined(program_keys(), solve_keys()))},
       .returns = "program",
       .run = make_program});
  library.type<QuadraticProgram>("A quadratic program: minimise 1/2 x'Px + q'x + r, low <= Ax <= high.")
      .setup("local program = dotyk.qp{ B = {{2, 0}, {0, 2}}, c = {2, 5}, D = {{1, 1}}, d = {1}, x_low = 0 }\n")
      .field("name", "its name, from a file", &QuadraticProgram::name)
      .field("unknowns", "how many x there are", &QuadraticProgram::unknowns)
      .field("rows", "of A, bounds included", &QuadraticProgram::rows)
      .field("equalities", "rows with low = high", equalities)
      .field("bounds", "rows with a single entry", bounds)
      .method({.name = "program:solve",
               .help = "Solves the program. A program without a solution, or not convex, gives a result whose status says so.",
               .example = "local r = program:solve{ method = \"active_set\", change = \"many\" }\nprint(r)",
               .arguments = {key::table(solve_keys())},
               .run = [](Call& call) { return solve_with(call, call.self<QuadraticProgram>()); }})
      .text([](const QuadraticProgram& p) {
        return text("program", p.name.empty() ? "" : " " + p.name, ": ", p.unknowns(), " unknowns, ", p.rows(), " rows (",
                    equalities(p), " equalities, ", bounds(p), " with a single entry)");
      });
  using R = ProgramResult;
  const auto of = [](const auto& member) { return [member](const R& r) { return std::invoke(member, r.result); }; };
  using Run = program::Result;
  library.type<R>("The result of solving a quadratic program.")
      .field("status", "\"solved\", \"infeasible\", \"unbounded\", \"not_convex\" or \"stopped\"",
             [](const R& r) { return program::text_of(r.result.status); })
      .field("converged", "status is \"solved\"", [](const R& r) { return r.result.status == program::Status::solved; })
      .field("reason", "why it ended, a sentence", of(&Run::reason))
      .field("method", "the method", &R::method)
      .field("x", "the unknowns", [](const R& r) { return list(r.result.x); })
      .field("y", "multipliers of the rows (D, A, bounds): positive at high, negative at low; Px + q + A'y = 0",
             [](const R& r) { return list(r.result.y); })
      .field("working", "active_set: each row's place, \"low\", \"high\", \"equal\" or \"free\"", working)
      .field("direction", "unbounded: along it the objective falls for ever; infeasible: weights of the rows that "
                          "contradict one another; not convex: of negative curvature",
             [](const R& r) { return list(r.result.direction); })
      .field("objective", "its value at x", of(&Run::objective))
      .field("residual", "stationarity, feasibility, complementarity, relative to the scales given beside them", program_residual_record)
      .field("bracket", "where the optimum lies, from x and y alone in extended precision: primal (the objective at x), "
                        "dual (no feasible point falls below it), gap between them and slack (what violated rows may "
                        "hide), both relative, violation", bracket_record)
      .field("iterations", "KKT systems solved for a step (active_set), or outer iterations", of(&Run::iterations))
      .field("predictor_iterations", "interior-point iterations that chose the first working set", of(&Run::predictor_iterations))
      .field("added", "rows that entered the working set", of(&Run::added))
      .field("dropped", "rows that left it", of(&Run::dropped))
      .field("singular", "singular KKT systems met", of(&Run::singular))
      .field("survived", "of these, the ones that still gave a step", of(&Run::survived))
      .field("factorisations", "of sparse KKT matrices", of(&Run::factorisations))
      .field("repeats", "times zigzagging was noticed, and the rule changed", of(&Run::repeats))
      .field("cg", "CG iterations of an augmented Lagrangian", of(&Run::cg))
      .field("penalty", "its last penalty", of(&Run::penalty))
      .field("seconds", "time taken", of(&Run::seconds), "s")
      .field("program", "what was solved", &R::program)
      .text(program_result_text);
  bind_lcp(library);
}

}  // namespace dotyk::script

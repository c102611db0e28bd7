#include "script/bind/models/models.hpp"

#include "base/stopwatch.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {

using fclib::ContactProblem;

std::shared_ptr<ContactProblemResult> solve_contact_problem(const std::shared_ptr<ContactProblem>& problem, const solver::Method& method,
                                                            Monitor& monitor) {
  const Stopwatch clock;
  auto result = std::make_shared<ContactProblemResult>(ContactProblemResult{problem, fclib::solve(*problem, method, monitor)});
  result->seconds = clock.seconds();
  return result;
}

namespace {

std::shared_ptr<ContactProblem> read_problem(Call& call) {
  Watch watch(call.state(), "reading");
  return std::make_shared<ContactProblem>(fclib::read(call.text("file"), watch));
}

std::shared_ptr<ContactProblemResult> solve_problem(Call& call) {
  const auto solver = call.object<Solver>("solver");
  Watch watch(call.state(), "solving", call.kept_function(2, "on_iteration"), solver->verbose);
  const auto result = solve_contact_problem(call.self<ContactProblem>(), solver->method, watch);
  watch.judge(result->result.iteration);
  watch.answer();
  return result;
}

std::vector<std::vector<double>> rows_of_W(const ContactProblem& p) {
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < p.rows(); ++i) rows.push_back(list(p.W.row(i)));
  return rows;
}

std::string kind(const ContactProblem& p) { return p.kind == ContactProblem::Kind::local ? "local" : "global"; }

void bind_problem(Library& library) {
  using P = ContactProblem;
  library.type<P>("A frictional contact problem from a file: u = Wr + q, with contact and Coulomb's law between u and r. "
                  "Components of a contact: normal, then one or two tangential ones.")
      .field("name", "the file's, without its folder", &P::name)
      .field("title", "as the file gives it, or empty", &P::title)
      .field("description", "as the file gives it, or empty", &P::description)
      .field("kind", "\"local\": the file gives W; \"global\": it gives M, H, f, w, and W = H'M^-1 H", kind)
      .field("dimension", "of space, and components a contact: 2 or 3", &P::dimension)
      .field("contacts", "how many", &P::contacts)
      .field("rows", "contacts times dimension", &P::rows)
      .field("unknowns", "local: rows; global: velocities of the bodies", &P::unknowns)
      .field("rank_W", "singular values of W above 1e-10 of the greatest; below rows, r need not be unique", fclib::rank_of_W)
      .field("unsymmetry", "largest |A - A'| over largest |A| of the matrix stored, W or M", fclib::unsymmetry)
      .field("symmetrised", "W was made of the symmetric part of M, which is unsymmetric by its rounding", &P::symmetrised)
      .field("mu", "friction coefficients, one a contact", [](const P& p) { return list(p.mu); })
      .field("q", "velocities without contact forces, contact by contact", [](const P& p) { return list(p.q); })
      .field("W", "a table of its rows, computed when read", rows_of_W)
      .method({.name = "contact_problem:solve",
               .help = "Solves the problem by a method that works on rows alone; solver:solve(problem) is the same.",
               .setup = setup::contact_problem(),
               .example = "local r = p:solve(dotyk.solver.newton{ tol = 1e-12 })\nprint(r.residual, r.stick)",
               .arguments = {key::object<Solver>("solver", "the method").required()},
               .run = solve_problem})
      .text([](const P& p) {
        return text("contact_problem ", p.name, ": ", kind(p), ", ", p.contacts(), " contacts in ", p.dimension, "-D, ",
                    p.unknowns(), " unknowns", p.symmetrised ? ", M symmetrised" : "");
      });
}

void bind_result(Library& library) {
  using R = ContactProblemResult;
  library.type<R>("The result of solving a frictional contact problem.")
      .field("residual", "|r - P(r - rho u^)| / |r|, P onto the cone |r_T| <= mu r_N, u^ = u + mu |u_T| e_N, rho = 1/max W_ii",
             [](const R& r) { return r.result.measure.residual; })
      .field("converged", "the method's own residual reached its tol", [](const R& r) { return r.result.iteration.converged; })
      .field("reason", "why it ended, a sentence", [](const R& r) { return r.result.iteration.reason; })
      .field("method", "the method", [](const R& r) { return r.result.iteration.method; })
      .field("iterations", "how many", [](const R& r) { return r.result.iteration.iterations; })
      .field("seconds", "time taken", &R::seconds, "s")
      .field("r", "contact forces, contact by contact", [](const R& r) { return list(r.result.r); })
      .field("u", "relative velocities Wr + q", [](const R& r) { return list(r.result.measure.u); })
      .field("open", "contacts without force", [](const R& r) { return r.result.measure.open; })
      .field("stick", "contacts that stick", [](const R& r) { return r.result.measure.stick; })
      .field("slip", "contacts that slip", [](const R& r) { return r.result.measure.slip; })
      .field("history", "one entry an iteration: active stick slip changed residual time", [](const R& r) { return history_records(r.result.iteration); })
      .field("problem", "what was solved", &R::problem)
      .text([](const R& r) {
        const auto& m = r.result.measure;
        return text("contact_problem_result (", r.result.iteration.method, "): ",
                    r.result.iteration.converged ? "converged" : "not converged", ", ", r.result.iteration.reason, "\n  residual ",
                    m.residual, ", ", r.result.iteration.iterations, " iterations, ", m.open, " open, ", m.stick, " stick, ", m.slip, " slip");
      });
}

}  // namespace

void bind_fclib(Library& library) {
  library.function(
      {.name = "dotyk.fclib",
       .help = "Reads a frictional contact problem: an HDF5 file of the FCLIB collection (fclib_local, fclib_global) or the "
               "plain text that siconos prints. Global problems, M v = Hr + f with u = H'v + w, come condensed to u = Wr + q. "
               "Rolling friction is refused.",
       .setup = setup::contact_problem(),
       .example = "local r = p:solve(dotyk.solver.newton{})\nprint(r.residual, r.open, r.stick, r.slip)",
       .arguments = {key::file("file", "the file's name").required()},
       .run = read_problem});
  bind_problem(library);
  bind_result(library);
}

}  // namespace dotyk::script

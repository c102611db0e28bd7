// What the library does to the process that it is opened in. doctest goes by the names of files: these cases come first.
#include <doctest/doctest.h>

#include <malloc.h>

#include <csignal>
#include <thread>
#include <utility>

#include "base/error.hpp"
#include "built.hpp"
#include "elastic_cube.hpp"

using namespace dotyk;

namespace {

using SignalAction = struct sigaction;

std::vector<SignalAction> signal_actions() {
  std::vector<SignalAction> actions(32);
  for (int s = 1; s < 32; ++s) sigaction(s, nullptr, &actions[s]);
  return actions;
}

void on_interrupt(int) {}

}  // namespace

TEST_CASE("where the library was not built, what to install is said") {
  if (multigrid::available()) return;
  Monitor monitor;
  const auto cube = test::cube_on_its_bottom(2);
  CHECK_THROWS_WITH_AS(multigrid::make_solver({cube.lower, cube.node, [&] { return cube.motions; }}, monitor), doctest::Contains("libpetsc-real-dev"), InputError);
}

TEST_CASE("signal handlers stay the program's") {
  if (test::not_built()) return;
  const auto before = std::signal(SIGINT, on_interrupt);
  const auto expected = signal_actions();
  Monitor monitor;
  const auto cube = test::cube_on_its_bottom(3);
  const auto solver = multigrid::make_solver({cube.lower, cube.node, [&] { return cube.motions; }}, monitor);
  const auto found = signal_actions();
  for (int s = 1; s < 32; ++s) CHECK((found[s].sa_handler == expected[s].sa_handler));
  CHECK((found[SIGINT].sa_handler == on_interrupt));
  std::signal(SIGINT, before);
}

TEST_CASE("several solvers at once, from several threads, ended in any order") {
  if (test::not_built()) return;
  Monitor monitor;
  std::vector<test::ElasticCube> cubes;
  std::vector<std::unique_ptr<algebra::SpdSolver>> solvers;
  for (const int n : {3, 6, 4}) {
    cubes.push_back(test::cube_on_its_bottom(n));
    solvers.push_back(multigrid::make_solver({cubes.back().lower, cubes.back().node, [&] { return cubes.back().motions; }}, monitor));
  }
  const auto solve = [&](std::size_t k) {
    const std::vector<char> held(cubes[k].node.size(), 0);
    solvers[k]->set(test::entries(cubes[k].lower), held);
    const algebra::Vector b = test::pressure_on_top(cubes[k], held), x = solvers[k]->solve(b, 1e-10);
    return (b - cubes[k].lower.selfadjointView<Eigen::Lower>() * x).norm() / b.norm();
  };
  double residual[3];
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < 3; ++k) threads.emplace_back([&, k] { residual[k] = solve(k); });
  for (std::thread& thread : threads) thread.join();
  for (const double r : residual) CHECK(r <= 1.01e-10);
  solvers[1].reset();
  CHECK(solve(2) <= 1.01e-10);
  solvers[0].reset();
  CHECK(solve(2) <= 1.01e-10);
}

#ifndef __SANITIZE_ADDRESS__  // which has no mallinfo2()
TEST_CASE("new numbers, and solvers that come and go, take no more memory each time") {
  if (test::not_built()) return;
  Monitor monitor;
  const auto cube = test::cube_on_its_bottom(6);
  const auto run = [&](algebra::SpdSolver& solver, int times) {
    for (int k = 0; k < times; ++k) {
      const auto held = test::disc_on_top(cube, 0.1 * (k % 5));
      solver.set(test::entries(test::holding(cube.lower, held)), held);
      solver.solve(test::pressure_on_top(cube, held), 1e-3);
    }
  };
  const auto used = [] {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
  };
  const auto solver = multigrid::make_solver({cube.lower, cube.node, [&] { return cube.motions; }}, monitor);
  run(*solver, 10);
  const double before = used();
  run(*solver, 100);
  CHECK(used() - before < 0.5 * solver->bytes() / 100 + 10e3);
  for (int k = 0; k < 20; ++k) run(*multigrid::make_solver({cube.lower, cube.node, [&] { return cube.motions; }}, monitor), 1);
  CHECK(used() - before < 0.5 * solver->bytes());
}
#endif

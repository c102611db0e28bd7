#include "script/bind/bind.hpp"
#include "script/bind/program/program_input.hpp"

namespace dotyk::script {
namespace {

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
  const auto rows = call.matrix("M");
  const auto q = call.vector("q");
  lcp.q = Eigen::Map<const algebra::Vector>(q.data(), static_cast<Eigen::Index>(q.size()));
  lcp.M.resize(static_cast<Eigen::Index>(rows.size()), lcp.q.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != q.size())
      throw InputError(text("row ", i + 1, " of M has ", rows[i].size(), " numbers; q has ", q.size()));
    for (std::size_t j = 0; j < q.size(); ++j) lcp.M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  }
  return lcp;
}

std::shared_ptr<LcpResult> solve_lcp(Call& call) {
  const Lcp lcp = given_lcp(call);
  LcpSettings settings;
  call.read("method", settings.method);
  call.read("unique", settings.unique);
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

}  // namespace

void bind_lcp(Library& library) {
  using Method = LcpSettings::Method;
  library.function(
      {.name = "dotyk.lcp",
       .help = "Solves a linear complementarity problem w = Mz + q >= 0, z >= 0, z'w = 0, M small, dense and not "
               "necessarily symmetric. The active-set method (newton_min) is tried first; where it goes round in "
               "circles, or meets a singular matrix, Lemke's method; up to 16 unknowns enumeration says whether there "
               "is no solution, or more than one.",
       .example = "local r = dotyk.lcp{ M = {{1, 0, 2}, {2, 1, 0}, {0, 2, 1}}, q = {1, 1, 1}, start = {1} }\n"
                  "print(r.status, #r.cycle, r.method)\nio.open(\"two.dat\", \"w\"):write \"2  0 2 2 2 2  2 1  1 2  -1 -1\":close()\nprint(dotyk.lcp \"two.dat\")",
       .arguments = {key::table(
           {key::file("file", "a file in the text format of siconos, instead of M and q").otherwise("none"),
            key::matrix("M", "n x n"), key::vector("q", "n"),
            key::choice<Method>("method", {{"automatic", Method::automatic}, {"newton_min", Method::newton_min}, {"lemke", Method::lemke},
                                           {"enumeration", Method::enumeration}}, "one method alone, or one after the other").fallback(Method::automatic),
            key::list("start", key::integer("", ""), "unknowns that are free (w = 0) in newton_min's first set").otherwise("none"),
            key::boolean("unique", "up to 16 unknowns: look for further solutions").fallback(true)})},
       .run = solve_lcp});
  library.type<LcpResult>("The result of a linear complementarity problem.")
      .field("status", "\"solved\", \"several\" (more than one solution), \"none\" (there is no solution) or \"stopped\"",
             [](const LcpResult& r) { return program::text_of(r.status); })
      .field("reason", "how it ended, in words", [](const LcpResult& r) { return r.reason; })
      .field("method", "the method that found z", [](const LcpResult& r) { return r.method; })
      .field("z", "the solution", [](const LcpResult& r) { return list(r.z); })
      .field("w", "Mz + q", [](const LcpResult& r) { return list(r.w); })
      .field("other", "a second solution; empty where none is known", [](const LcpResult& r) { return list(r.other); })
      .field("cycle", "the sets of free unknowns among which newton_min went round, in order; empty where it did not", cycle)
      .field("solves", "linear systems newton_min solved", [](const LcpResult& r) { return r.solves; })
      .field("pivots", "of Lemke's method", [](const LcpResult& r) { return r.pivots; })
      .field("counted", "was it decided whether there are further solutions?", [](const LcpResult& r) { return r.counted; })
      .field("residual", "largest min(z, w), relative row by row", [](const LcpResult& r) { return r.residual; })
      .text([](const LcpResult& r) { return text("lcp_result: ", program::text_of(r.status), ", ", r.reason); });
}

}  // namespace dotyk::script

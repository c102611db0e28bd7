#include "shape/optimise/linear_program.hpp"

#include <glpk.h>

#include <cmath>
#include <csetjmp>
#include <vector>

#include "base/error.hpp"

namespace dotyk::shape {
namespace {

void check(const LinearProgram& p) {
  const Eigen::Index n = p.g.size(), m = p.b.size();
  if (p.lower.size() != n || p.upper.size() != n || p.A.rows() != m || (m > 0 && p.A.cols() != n))
    throw InputError(text("a linear program of ", n, " unknowns and ", m, " rows with a matrix of ", p.A.rows(), " x ", p.A.cols(), ", ",
                          p.lower.size(), " lower and ", p.upper.size(), " upper bounds"));
  if (!p.g.allFinite() || !p.A.allFinite()) throw InputError("a linear program's objective and matrix must be finite");
  for (Eigen::Index r = 0; r < m; ++r)
    if (std::isnan(p.b[r]) || p.b[r] == -INFINITY) throw InputError(text("row ", r + 1, " of a linear program must be at most ", p.b[r]));
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(p.lower[i] <= p.upper[i]) || p.lower[i] == INFINITY || p.upper[i] == -INFINITY)
      throw InputError(text("unknown ", i + 1, " of a linear program is bounded by ", p.lower[i], " and ", p.upper[i]));
}

int kind(double lower, double upper) {
  const bool below = std::isfinite(lower), above = std::isfinite(upper);
  if (below && above) return lower == upper ? GLP_FX : GLP_DB;
  return below ? GLP_LO : above ? GLP_UP : GLP_FR;
}

/// Indices and values as GLPK takes them: from 1. Made before, so that no C++ object lives where GLPK may jump out of.
struct Entries {
  std::vector<int> row, column;
  std::vector<double> value;
  explicit Entries(const algebra::DenseMatrix& A) : row(1), column(1), value(1) {
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (Eigen::Index i = 0; i < A.rows(); ++i)
        if (A(i, j) != 0) row.push_back(static_cast<int>(i) + 1), column.push_back(static_cast<int>(j) + 1), value.push_back(A(i, j));
  }
};

void pose(glp_prob* lp, const LinearProgram& p, const Entries& entries) {
  const int n = static_cast<int>(p.g.size()), m = static_cast<int>(p.b.size());
  glp_set_obj_dir(lp, GLP_MIN);
  if (n > 0) glp_add_cols(lp, n);
  for (int i = 0; i < n; ++i) {
    glp_set_col_bnds(lp, i + 1, kind(p.lower[i], p.upper[i]), p.lower[i], p.upper[i]);
    glp_set_obj_coef(lp, i + 1, p.g[i]);
  }
  if (m > 0) glp_add_rows(lp, m);
  for (int r = 0; r < m; ++r) glp_set_row_bnds(lp, r + 1, kind(-INFINITY, p.b[r]), 0, p.b[r]);
  glp_load_matrix(lp, static_cast<int>(entries.value.size()) - 1, entries.row.data(), entries.column.data(), entries.value.data());
}

/// GLPK's answer to a failure of its own is to end the process; this leaves it instead. Its memory must be freed then.
[[noreturn]] void leave(void* place) { std::longjmp(*static_cast<std::jmp_buf*>(place), 1); }

constexpr int kBroken = -1;  ///< GLPK stopped itself

/// The simplex method's return code, the program left in `lp`.
int run(glp_prob* lp, const LinearProgram& p, const Entries& entries) {
  std::jmp_buf place;
  if (setjmp(place)) return kBroken;  // NOLINT: nothing with a destructor lies between
  glp_error_hook(leave, &place);
  pose(lp, p, entries);
  glp_scale_prob(lp, GLP_SF_AUTO);
  glp_adv_basis(lp, 0);
  glp_smcp settings;
  glp_init_smcp(&settings);
  settings.msg_lev = GLP_MSG_OFF;
  settings.tol_bnd = settings.tol_dj = 1e-9;
  int code = glp_simplex(lp, &settings);
  if (code != 0) {  // the first basis was singular, say: the one of all slack variables is not
    glp_std_basis(lp);
    code = glp_simplex(lp, &settings);
  }
  glp_error_hook(nullptr, nullptr);
  return code;
}

LinearSolution none(LinearStatus status, std::string reason) {
  LinearSolution solution;
  solution.status = status;
  solution.reason = std::move(reason);
  return solution;
}

LinearSolution read(glp_prob* lp, const LinearProgram& p) {
  LinearSolution s;
  s.status = LinearStatus::solved;
  s.d.resize(p.g.size());
  s.y.resize(p.b.size());
  for (Eigen::Index i = 0; i < s.d.size(); ++i) s.d[i] = std::min(std::max(glp_get_col_prim(lp, static_cast<int>(i) + 1), p.lower[i]), p.upper[i]);
  for (Eigen::Index r = 0; r < s.y.size(); ++r) s.y[r] = std::max(0.0, -glp_get_row_dual(lp, static_cast<int>(r) + 1));
  s.z = p.g;
  if (s.y.size() > 0) s.z += p.A.transpose() * s.y;
  s.value = p.g.dot(s.d);
  return s;
}

struct Environment {
  Environment() { glp_term_out(GLP_OFF); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { glp_free_env(); }  // and with it every program made since
};

}  // namespace

LinearSolution minimise(const LinearProgram& program) {
  check(program);
  const Entries entries(program.A);
  const Environment environment;
  glp_prob* lp = glp_create_prob();
  const int code = run(lp, program, entries);
  if (code != 0)
    return none(LinearStatus::failed, code == kBroken ? "the simplex method broke down" : text("the simplex method failed (GLPK's code ", code, ")"));
  switch (glp_get_status(lp)) {
    case GLP_OPT: return read(lp, program);
    case GLP_NOFEAS: return none(LinearStatus::infeasible, "no point satisfies all rows and bounds");
    case GLP_UNBND: return none(LinearStatus::unbounded, "the objective falls without end");
    default: return none(LinearStatus::failed, "the simplex method ended without an answer");
  }
}

}  // namespace dotyk::shape

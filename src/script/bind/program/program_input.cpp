#include "script/bind/program/program_input.hpp"

#include "program/program_file.hpp"
#include "script/bind/bind.hpp"
#include "script/bridge/position.hpp"
#include "script/bind/scene/space.hpp"

namespace dotyk::script {
namespace {

using program::SparseMatrix;
using program::SparseRows;
using program::Vector;
using Entries = algebra::Triplets;

struct Matrix {
  Entries entries;
  int rows = 0;
};

/// The entries of a matrix with this many columns.
Matrix matrix_of(const Arguments& given, const std::string& name, int columns) {
  const Arguments table = given.table(name);
  const bool triplets = table.has("i") || table.has("j") || table.has("value");
  Matrix out;
  if (triplets) {
    if (table.item_count() > 0) throw InputError(text("'", name, "' has rows and triplets; give one of them"));
    if (!table.has("i") || !table.has("j") || !table.has("value")) throw InputError(text("'", name, "' needs i, j and value together"));
    const auto i = table.integers("i"), j = table.integers("j");
    const auto value = table.vector("value");
    if (i.size() != j.size() || i.size() != value.size())
      throw InputError(text("'", name, "' has ", i.size(), " i, ", j.size(), " j and ", value.size(), " values"));
    for (std::size_t k = 0; k < i.size(); ++k) {
      if (j[k] > columns) throw InputError(text("'", name, "': entry ", k + 1, " is in column ", j[k], "; there are ", columns));
      out.rows = std::max(out.rows, static_cast<int>(i[k]));
      out.entries.emplace_back(static_cast<int>(i[k] - 1), static_cast<int>(j[k] - 1), value[k]);
    }
    return out;
  }
  const auto rows = read_value<std::vector<std::vector<double>>>(given.state(), given.slot(name));
  out.rows = static_cast<int>(rows.size());
  for (int r = 0; r < out.rows; ++r) {
    const auto& row = rows[r];
    if (static_cast<int>(row.size()) != columns)
      throw InputError(text("row ", r + 1, " of '", name, "' has ", row.size(), " numbers; there are ", columns, " unknowns"));
    for (int j = 0; j < columns; ++j)
      if (row[j] != 0) out.entries.emplace_back(r, j, row[j]);
  }
  return out;
}

/// Rows low ≤ A x ≤ high, gathered from several keys.
class Rows {
 public:
  explicit Rows(int columns) : columns_(columns) {}
  void add(const Matrix& matrix, int rows, const Vector& low, const Vector& high) {
    for (const auto& e : matrix.entries)
      entries_.emplace_back(static_cast<int>(low_.size()) + e.row(), e.col(), e.value());
    for (int r = 0; r < rows; ++r) low_.push_back(low[r]), high_.push_back(high[r]);
  }
  void bounds(const Vector& low, const Vector& high) {
    for (int j = 0; j < columns_; ++j) {
      if (std::isinf(low[j]) && std::isinf(high[j])) continue;
      entries_.emplace_back(static_cast<int>(low_.size()), j, 1.0);
      low_.push_back(low[j]), high_.push_back(high[j]);
    }
  }
  void into(program::QuadraticProgram& p) const {
    p.low = vector_of(low_), p.high = vector_of(high_);
    p.A = SparseRows(p.low.size(), columns_);
    p.A.setFromTriplets(entries_.begin(), entries_.end());
  }

 private:
  int columns_;
  Entries entries_;
  std::vector<double> low_, high_;
};

/// A vector of limits: a number for all or one each. Infinite where it is not given.
Vector limits(const Arguments& given, const std::string& name, int count, double otherwise) {
  if (!given.has(name)) return Vector::Constant(count, otherwise);
  lua_State* L = given.state();
  const int at = given.slot(name);
  if (given.is(name, LUA_TNUMBER)) return Vector::Constant(count, lua_tonumber(L, at));
  if (!given.is(name, LUA_TTABLE)) throw InputError(text("'", name, "' must be a number or a table of numbers, got ", describe_value(L, at)));
  if (const auto size = static_cast<int>(lua_rawlen(L, at)); size != count)
    throw InputError(text("'", name, "' has ", size, " entries; it must have ", count));
  int k = 0;
  return vector_of(read_list(L, at, [&](int entry) {
    if (++k; lua_type(L, entry) != LUA_TNUMBER) throw InputError(text("entry ", k, " of '", name, "' is no number"));
    return lua_tonumber(L, entry);
  }));
}

Key limits_key(std::string name, std::string help, std::string otherwise) {
  return key::any(std::move(name), std::move(help) + ": a number, or one for each; ±math.huge where there is none")
      .otherwise(std::move(otherwise));
}

void read_rows(const Arguments& given, program::QuadraticProgram& p, int n) {
  Rows rows(n);
  if (given.has("D")) {
    const Matrix D = matrix_of(given, "D", n);
    const Vector d = given.has("d") ? vector_of(given.vector("d")) : Vector(Vector::Zero(D.rows));
    if (d.size() < D.rows) throw InputError(text("'d' has ", d.size(), " entries; 'D' has ", D.rows, " rows"));
    rows.add(D, static_cast<int>(d.size()), d, d);
  } else if (given.has("d")) {
    throw InputError("'d' is given without 'D'");
  }
  if (given.has("A")) {
    if (!given.has("low") && !given.has("high")) throw InputError("'A' is given without 'low' or 'high'");
    const Matrix A = matrix_of(given, "A", n);
    rows.add(A, A.rows, limits(given, "low", A.rows, -INFINITY), limits(given, "high", A.rows, INFINITY));
  } else if (given.has("low") || given.has("high")) {
    throw InputError("'low' and 'high' belong to 'A', which is missing (bounds of x are x_low and x_high)");
  }
  if (given.has("x_low") || given.has("x_high"))
    rows.bounds(limits(given, "x_low", n, -INFINITY), limits(given, "x_high", n, INFINITY));
  rows.into(p);
}

// By its ending: .qps, .mps or .mat.
program::QuadraticProgram read_program_file(const std::string& file, Monitor& monitor) {
  if (file.ends_with(".mat")) return program::read_mat(file, monitor);
  for (const char* ending : {".qps", ".QPS", ".mps", ".MPS"})
    if (file.ends_with(ending)) return program::read_qps(file);
  throw InputError("'" + file + "' ends neither in .qps or .mps nor in .mat");
}

}  // namespace

Key matrix_key(std::string name, std::string help) {
  return key::table(std::move(name),
                    {key::list("i", key::integer("", "").at_least(1), "rows of the entries, from 1"),
                     key::list("j", key::integer("", "").at_least(1), "their columns, from 1"),
                     key::vector("value", "their values; entries at one place are added")},
                    std::move(help) + "; rows of numbers, or triplets { i = {…}, j = {…}, value = {…} }")
      .with(key::vector("row", "the numbers of a row"));
}

std::vector<Key> program_keys() {
  return {key::file("file", "a program in a .qps, .mps or .mat file, instead of the matrices").otherwise("none"),
          matrix_key("B", "quadratic term, symmetric"), key::vector("c", "linear term: the objective has -c'x"),
          matrix_key("D", "rows of the equalities Dx = d"), key::vector("d", "their right-hand sides").otherwise("zeros"),
          matrix_key("A", "rows of the inequalities low <= Ax <= high"),
          limits_key("low", "lower limits of Ax", "none"), limits_key("high", "upper limits of Ax", "none"),
          limits_key("x_low", "lower bounds of x", "none"), limits_key("x_high", "upper bounds of x", "none")};
}

algebra::SparseMatrix square_matrix(const Arguments& given, const std::string& name, int n, const std::string& vector) {
  const Matrix M = matrix_of(given, name, n);
  const bool triplets = given.table(name).has("i");  // whose last rows may be empty
  if (M.rows > n || (!triplets && M.rows < n))
    throw InputError(text("'", name, "' has ", M.rows, " rows; '", vector, "' has ", n, " entries"));
  return algebra::from_triplets(n, n, M.entries);
}

std::shared_ptr<program::QuadraticProgram> read_program(const Arguments& given, Monitor& monitor) {
  auto p = std::make_shared<program::QuadraticProgram>();
  if (given.has("file")) {
    for (const char* name : {"B", "c", "D", "d", "A", "low", "high", "x_low", "x_high"})
      if (given.has(name)) throw InputError(text("give either a file, or matrices ('", name, "')"));
    *p = read_program_file(given.text("file"), monitor);
    return p;
  }
  if (!given.has("c")) throw InputError("'c' (the linear term, one number an unknown) is missing");
  p->q = -vector_of(given.vector("c"));
  const int n = p->unknowns();
  p->P = SparseMatrix(n, n);
  if (given.has("B")) {
    const SparseMatrix full = square_matrix(given, "B", n, "c");
    const SparseMatrix transposed = full.transpose();
    if ((full - transposed).norm() > 1e-12 * full.norm()) throw InputError("'B' is not symmetric");
    p->P = full.triangularView<Eigen::Lower>();
  }
  read_rows(given, *p, n);
  program::check(*p);
  return p;
}

}  // namespace dotyk::script

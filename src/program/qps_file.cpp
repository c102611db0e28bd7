#include "program/qps_file.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/in_quotes.hpp"
#include "base/memory.hpp"
#include "base/readable_file.hpp"
#include "base/text.hpp"

namespace dotyk::program {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

class QpsReader {
 public:
  QpsReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  QuadraticProgram read() {
    std::string line;
    while (!ended_ && std::getline(in_, line)) {
      ++number_;
      if (line.empty() || line[0] == '*') continue;
      std::istringstream stream(line);
      fields_.clear();
      for (std::string field; fields_.size() <= kMostFields && stream >> field;) fields_.push_back(field);
      if (fields_.empty()) continue;
      if (line[0] != ' ' && line[0] != '\t') header();
      else if (fields_.size() > kMostFields) fail(text("a line of more than ", kMostFields, " words"));
      else entry();
    }
    if (!ended_) fail("the file ends without ENDATA");
    return program();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(text(name_, ":", number_, ": ", what)); }

  void header() {
    section_ = fields_[0];
    static const char* known[] = {"NAME", "OBJSENSE", "ROWS", "COLUMNS", "RHS", "RANGES", "BOUNDS",
                                  "QUADOBJ", "QSECTION", "QMATRIX", "ENDATA"};
    bool found = false;
    for (const char* one : known) found = found || section_ == one;
    if (!found) fail("unknown section " + in_quotes(section_));
    set_.clear();
    if (section_ == "NAME" && fields_.size() > 1) out_.name = fields_[1];
    if (section_ == "OBJSENSE" && fields_.size() > 1) sense(fields_[1]);
    ended_ = section_ == "ENDATA";
  }

  void entry() {
    if (section_ == "OBJSENSE") sense(fields_[0]);
    else if (section_ == "ROWS") row();
    else if (section_ == "COLUMNS") column();
    else if (section_ == "RHS" || section_ == "RANGES") right_hand_side();
    else if (section_ == "BOUNDS") bound();
    else if (section_ == "QUADOBJ" || section_ == "QSECTION" || section_ == "QMATRIX") quadratic();
    else fail(section_.empty() ? "an entry before the first section" : "section " + section_ + " takes no entries");
  }

  void sense(const std::string& word) {
    if (word == "MAX" || word == "MAXIMIZE") maximise_ = true;
    else if (word != "MIN" && word != "MINIMIZE") fail("objective sense " + in_quotes(word) + "; it must be MIN or MAX");
  }

  void row() {
    if (fields_.size() != 2) fail("a row needs a type and a name");
    const std::string& type = fields_[0];
    if (type != "N" && type != "E" && type != "L" && type != "G") fail("row type " + in_quotes(type) + "; it must be N, E, L or G");
    if (rows_.count(fields_[1])) fail("row " + in_quotes(fields_[1]) + " is named twice");
    if (type == "N") {
      rows_[fields_[1]] = has_objective_ ? kLeftOut : kObjective;
      has_objective_ = true;
      return;
    }
    rows_[fields_[1]] = static_cast<int>(types_.size());
    types_.push_back(type[0]);
    rhs_.push_back(0);
    range_.push_back(NAN);
  }

  void column() {
    if (fields_.size() > 1 && fields_[1] == "'MARKER'") fail("integer variables are not supported");
    if (fields_.size() != 3 && fields_.size() != 5) fail("a column needs its name and one or two pairs of row and value");
    const auto [place, added] = columns_.try_emplace(fields_[0], static_cast<int>(columns_.size()));
    if (added) {
      q_.push_back(0);
      low_.push_back(0);
      high_.push_back(INFINITY);
      low_given_.push_back(false);
    }
    for (std::size_t k = 1; k < fields_.size(); k += 2) {
      const int r = row_named(fields_[k]);
      const double value = number(fields_[k + 1]);
      if (r == kObjective) q_[place->second] += value;
      else if (r != kLeftOut) A_.emplace_back(r, place->second, value);
    }
  }

  void right_hand_side() {
    const std::size_t first = fields_.size() % 2;
    if (fields_.size() < 2) fail("a right-hand side needs a row and a value");
    if (first && !in_set(fields_[0])) return;
    for (std::size_t k = first; k < fields_.size(); k += 2) {
      const int r = row_named(fields_[k]);
      const double value = number(fields_[k + 1]);
      if (r == kObjective && std::isinf(value)) fail("the constant of the objective is not finite");
      if (r == kObjective && section_ == "RHS") constant_ = -value;
      else if (r >= 0) (section_ == "RHS" ? rhs_ : range_)[r] = value;
    }
  }

  void bound() {
    const std::string type = fields_[0];
    const bool valued = type == "LO" || type == "UP" || type == "FX";
    if (type == "BV" || type == "LI" || type == "UI" || type == "SC") fail("bound type " + type + ": integer and semicontinuous variables are not supported");
    if (!valued && type != "FR" && type != "MI" && type != "PL") fail("bound type " + in_quotes(type) + "; it must be LO, UP, FX, FR, MI or PL");
    // The name of the set may be left out; a value behind FR, MI and PL may be there.
    const std::size_t least = valued ? 3 : 2;
    if (fields_.size() < least) fail("a bound needs a type, a column" + std::string(valued ? " and a value" : ""));
    const bool named = valued ? fields_.size() > 3 : !columns_.count(fields_[1]) || (fields_.size() > 2 && columns_.count(fields_[2]));
    if (named && fields_.size() < least + 1) fail("unknown column " + in_quotes(fields_[1]));
    if (named && !in_set(fields_[1])) return;
    const int j = column_named(fields_[named ? 2 : 1]);
    const double value = valued ? number(fields_[named ? 3 : 2]) : 0;
    if (type == "LO" || type == "FX") low_[j] = value, low_given_[j] = true;
    if (type == "UP" || type == "FX") high_[j] = value;
    if (type == "FR" || type == "MI") low_[j] = -INFINITY, low_given_[j] = true;
    if (type == "FR" || type == "PL") high_[j] = INFINITY;
    if (type == "UP" && value < 0 && !low_given_[j]) low_[j] = -INFINITY;
  }

  void quadratic() {
    if (fields_.size() != 3) fail("an entry of the quadratic matrix needs two columns and a value");
    int i = column_named(fields_[0]), j = column_named(fields_[1]);
    const double value = number(fields_[2]);
    if (section_ == "QMATRIX") {
      if (i >= j) P_.emplace_back(i, j, value);
      if (i != j) both_[{std::min(i, j), std::max(i, j)}] += i > j ? value : -value;
    } else {
      if (i < j) std::swap(i, j);
      P_.emplace_back(i, j, value);
    }
  }

  bool in_set(const std::string& name) {
    if (set_.empty()) set_ = name;
    return set_ == name;
  }

  int row_named(const std::string& name) const {
    const auto found = rows_.find(name);
    if (found == rows_.end()) fail("unknown row " + in_quotes(name));
    return found->second;
  }
  int column_named(const std::string& name) const {
    const auto found = columns_.find(name);
    if (found == columns_.end()) fail("unknown column " + in_quotes(name));
    return found->second;
  }
  double number(const std::string& field) const {
    static const locale_t points = newlocale(LC_ALL_MASK, "C", nullptr);  // a script may have asked for commas
    char* end = nullptr;
    const double value = strtod_l(field.c_str(), &end, points);
    if (end == field.c_str() || *end || std::isnan(value)) fail(in_quotes(field) + " is not a number");
    return std::abs(value) >= 1e20 ? std::copysign(INFINITY, value) : value;
  }

  QuadraticProgram program() {
    const int n = static_cast<int>(columns_.size());
    int m = static_cast<int>(types_.size());
    if (!has_objective_) fail("no row of type N: there is no objective");
    for (const auto& [pair, difference] : both_)
      if (difference != 0) fail("QMATRIX is not symmetric: give both triangles, or QUADOBJ and one");
    for (int r = 0; r < m; ++r) {
      const double b = rhs_[r], width = std::isnan(range_[r]) ? 0 : range_[r];
      const bool ranged = !std::isnan(range_[r]);
      double low = types_[r] == 'L' ? -INFINITY : b, high = types_[r] == 'G' ? INFINITY : b;
      if (ranged && types_[r] == 'L') low = b - std::abs(width);
      if (ranged && types_[r] == 'G') high = b + std::abs(width);
      if (ranged && types_[r] == 'E') (width < 0 ? low : high) += width;
      lows_.push_back(low), highs_.push_back(high);
    }
    for (int j = 0; j < n; ++j) {
      if (std::isinf(low_[j]) && std::isinf(high_[j])) continue;
      A_.emplace_back(m++, j, 1.0);
      lows_.push_back(low_[j]), highs_.push_back(high_[j]);
    }
    const double sign = maximise_ ? -1 : 1;
    out_.P = SparseMatrix(n, n);
    out_.P.setFromTriplets(P_.begin(), P_.end());
    out_.P *= sign;
    out_.q = sign * Eigen::Map<Vector>(q_.data(), n);
    out_.r = sign * constant_;
    out_.A = SparseRows(m, n);
    out_.A.setFromTriplets(A_.begin(), A_.end());
    out_.low = Eigen::Map<Vector>(lows_.data(), m);
    out_.high = Eigen::Map<Vector>(highs_.data(), m);
    check(out_);
    return out_;
  }

  static constexpr int kObjective = -1, kLeftOut = -2;
  static constexpr std::size_t kMostFields = 20;
  std::istream& in_;
  std::string name_, section_, set_;
  int number_ = 0;
  bool ended_ = false, has_objective_ = false, maximise_ = false;
  std::vector<std::string> fields_;
  std::map<std::string, int> rows_, columns_;
  std::string types_;
  std::vector<double> rhs_, range_, q_, low_, high_, lows_, highs_;
  std::vector<bool> low_given_;
  double constant_ = 0;
  Entries A_, P_;
  std::map<std::pair<int, int>, double> both_;  ///< of QMATRIX: lower less upper entries
  QuadraticProgram out_;
};

}  // namespace

QuadraticProgram read_qps(std::istream& in, const std::string& name) { return QpsReader(in, name).read(); }

QuadraticProgram read_qps(const std::string& file) {
  require_readable(file);
  std::ifstream in(file);
  require_memory(10.0 * static_cast<double>(std::filesystem::file_size(file)), "'" + file + "'");
  return read_qps(in, file);
}

}  // namespace dotyk::program

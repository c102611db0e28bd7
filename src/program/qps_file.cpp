#include "program/program_file.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "base/memory.hpp"
#include "base/place.hpp"
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
    using R = QpsReader;
    static const std::map<std::string, void (R::*)()> sections = {
        {"NAME", nullptr}, {"OBJSENSE", &R::objective_sense}, {"ROWS", &R::row}, {"COLUMNS", &R::column},
        {"RHS", &R::right_hand_side}, {"RANGES", &R::right_hand_side}, {"BOUNDS", &R::bound}, {"QUADOBJ", &R::quadratic},
        {"QSECTION", &R::quadratic}, {"QMATRIX", &R::quadratic}, {"ENDATA", nullptr}};
    section_ = fields_[0];
    const auto found = sections.find(section_);
    if (found == sections.end()) fail("unknown section " + in_quotes(section_));
    take_entry_ = found->second;
    set_.clear();
    if (section_ == "NAME" && fields_.size() > 1) out_.name = fields_[1];
    if (section_ == "OBJSENSE" && fields_.size() > 1) sense(fields_[1]);
    ended_ = section_ == "ENDATA";
  }

  void entry() {
    if (!take_entry_) fail(section_.empty() ? "an entry before the first section" : "section " + section_ + " takes no entries");
    (this->*take_entry_)();
  }

  void objective_sense() { sense(fields_[0]); }

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
    rows_[fields_[1]] = static_cast<int>(row_.size());
    row_.push_back({type[0]});
  }

  void column() {
    if (fields_.size() > 1 && fields_[1] == "'MARKER'") fail("integer variables are not supported");
    if (fields_.size() != 3 && fields_.size() != 5) fail("a column needs its name and one or two pairs of row and value");
    const auto [place, added] = columns_.try_emplace(fields_[0], static_cast<int>(columns_.size()));
    if (added) column_.emplace_back();
    for (std::size_t k = 1; k < fields_.size(); k += 2) {
      const int r = row_named(fields_[k]);
      const double value = number(fields_[k + 1]);
      if (r == kObjective) column_[place->second].q += value;
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
      else if (r >= 0) (section_ == "RHS" ? row_[r].rhs : row_[r].range) = value;
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
    Column& column = column_[column_named(fields_[named ? 2 : 1])];
    const double value = valued ? number(fields_[named ? 3 : 2]) : 0;
    if (type == "LO" || type == "FX") column.low = value, column.low_given = true;
    if (type == "UP" || type == "FX") column.high = value;
    if (type == "FR" || type == "MI") column.low = -INFINITY, column.low_given = true;
    if (type == "FR" || type == "PL") column.high = INFINITY;
    if (type == "UP" && value < 0 && !column.low_given) column.low = -INFINITY;
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

  int row_named(const std::string& name) const { return named(rows_, "row", name); }
  int column_named(const std::string& name) const { return named(columns_, "column", name); }
  int named(const std::map<std::string, int>& all, const char* kind, const std::string& name) const {
    const auto found = all.find(name);
    if (found == all.end()) fail(text("unknown ", kind, " ", in_quotes(name)));
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
    if (!has_objective_) fail("no row of type N: there is no objective");
    for (const auto& [pair, difference] : both_)
      if (difference != 0) fail("QMATRIX is not symmetric: give both triangles, or QUADOBJ and one");
    const double sign = maximise_ ? -1 : 1;
    std::vector<double> lows, highs;
    for (const Row& row : row_) {
      double low = row.type == 'L' ? -INFINITY : row.rhs, high = row.type == 'G' ? INFINITY : row.rhs;
      const bool ranged = !std::isnan(row.range);
      if (ranged && row.type == 'L') low = row.rhs - std::abs(row.range);
      if (ranged && row.type == 'G') high = row.rhs + std::abs(row.range);
      if (ranged && row.type == 'E') (row.range < 0 ? low : high) += row.range;
      lows.push_back(low), highs.push_back(high);
    }
    out_.q.resize(n);
    for (int j = 0; j < n; ++j) {
      const Column& column = column_[j];
      out_.q[j] = sign * column.q;
      if (std::isinf(column.low) && std::isinf(column.high)) continue;
      A_.emplace_back(static_cast<int>(lows.size()), j, 1.0);
      lows.push_back(column.low), highs.push_back(column.high);
    }
    const auto m = static_cast<int>(lows.size());
    out_.P = SparseMatrix(n, n);
    out_.P.setFromTriplets(P_.begin(), P_.end());
    out_.P *= sign;
    out_.r = sign * constant_;
    out_.A = SparseRows(m, n);
    out_.A.setFromTriplets(A_.begin(), A_.end());
    out_.low = Eigen::Map<Vector>(lows.data(), m);
    out_.high = Eigen::Map<Vector>(highs.data(), m);
    check(out_);
    return out_;
  }

  struct Row {
    char type;
    double rhs = 0, range = NAN;
  };
  struct Column {
    double q = 0, low = 0, high = INFINITY;
    bool low_given = false;
  };

  static constexpr int kObjective = -1, kLeftOut = -2;
  static constexpr std::size_t kMostFields = 20;
  std::istream& in_;
  std::string name_, section_, set_;
  void (QpsReader::*take_entry_)() = nullptr;  ///< of the section
  int number_ = 0;
  bool ended_ = false, has_objective_ = false, maximise_ = false;
  std::vector<std::string> fields_;
  std::map<std::string, int> rows_, columns_;
  std::vector<Row> row_;
  std::vector<Column> column_;
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

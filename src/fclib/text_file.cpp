#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/listed.hpp"
#include "base/memory.hpp"
#include "fclib/contact_problem.hpp"

namespace dotyk::fclib {
namespace {

using algebra::SparseMatrix;
using algebra::Vector;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Reads numbers one after the other; its errors name file, line and what was looked for.
class Numbers {
 public:
  explicit Numbers(const std::string& file) : file_(file) {
    std::ifstream in(file, std::ios::binary);
    // The text twice, and its numbers as entries of a matrix.
    if (std::error_code none; in) require_memory(10.0 * static_cast<double>(std::filesystem::file_size(file, none)), "'" + file + "'");
    std::ostringstream whole;
    if (!in || !(whole << in.rdbuf())) throw InputError("cannot read '" + file + "'");
    content_ = whole.str();
  }

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(content_.begin(), content_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(text(file_, ":", line, ": ", what));
  }

  double number(const char* what) {
    const std::string_view word = next();
    if (word.empty()) fail(text("the file ends where ", what, " is expected"));
    double x = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || end != word.data() + word.size())
      fail(text(in_quotes(word), " stands where ", what, " is expected"));
    return x;
  }
  int count(const char* what, int least, int most) {
    const double x = number(what);
    if (!(x >= least && x <= most) || x != static_cast<int>(x))
      fail(text(what, " is ", x, least == most ? text("; ", least, " is expected") : text("; from ", least, " to ", most, " is expected")));
    return static_cast<int>(x);
  }
  /// Throws where what is left of the file cannot hold so many numbers.
  void require(double numbers, const char* what) const {
    if (2 * numbers > static_cast<double>(content_.size() - at_) + 1) fail(text("the file is too short for ", numbers, " ", what));
  }
  Vector vector(const char* what, int size) {
    Vector v(size);
    for (double& x : v) x = number(what);
    return v;
  }
  /// A count with a comma behind it.
  int leading_count(const char* what) {
    const std::string_view word = next();
    int n = -1;
    std::from_chars(word.data(), word.data() + word.size(), n);
    if (n < 0 || n > kMost) fail(text(in_quotes(word), " stands where ", what, " is expected"));
    return n;
  }
  void skip_line() { at_ = std::min(content_.find('\n', at_), content_.size()); }
  void skip(std::string_view expected) {
    if (next() != expected) fail(text("'", std::string(expected), "' is expected"));
  }
  /// Do these whole numbers come next? Nothing is read.
  bool ahead(std::initializer_list<int> numbers) {
    const std::size_t here = at_;
    bool all = true;
    for (const int n : numbers) all = all && next() == std::to_string(n);
    at_ = here;
    return all;
  }
  std::string_view peek() {
    const std::size_t here = at_;
    const std::string_view word = next();
    at_ = here;
    return word;
  }
  int words_left() {
    const std::size_t here = at_;
    int count = 0;
    while (!next().empty()) ++count;
    at_ = here;
    return count;
  }

 private:
  std::string_view next() {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    while (at_ < content_.size() && blank(content_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < content_.size() && !blank(content_[at_])) ++at_;
    return std::string_view(content_).substr(start, at_ - start);
  }

  std::string file_, content_;
  std::size_t at_ = 0;
};

/// Down the columns, though a line looks like a row.
void dense(Numbers& in, int rows, int columns, Entries& entries) {
  in.count("the number of rows", rows, rows);
  in.count("the number of columns", columns, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i)
      if (const double x = in.number("an entry of a matrix"); x != 0) entries.emplace_back(i, j, x);
}

/// Blocks by compressed rows: their number, the blocks a side, the cumulated sizes, the two index arrays, and for
/// each block its number and its entries down its columns.
void blocks(Numbers& in, int rows, int columns, Entries& entries) {
  const int total = in.count("the number of blocks", 0, kMost);
  const int down = in.count("the number of block rows", 0, rows), across = in.count("the number of block columns", 0, columns);
  const auto ends = [&](int size, int last) {
    std::vector<int> list{0};
    for (int k = 0; k < size; ++k) list.push_back(in.count("the end of a block", list.back() + 1, last));
    if (list.back() != last) in.fail(text("the blocks end at ", list.back(), " of ", last));
    return list;
  };
  const std::vector<int> row = ends(down, rows), column = ends(across, columns);
  const int starts = in.count("the length of the row index", down + 1, down + 1);
  in.count("the length of the column index", total, total);
  std::vector<int> first, place;
  for (int k = 0; k < starts; ++k)
    first.push_back(in.count("an entry of the row index", first.empty() ? 0 : first.back(), k ? total : 0));
  if (first.back() != total) in.fail(text("the row index ends at ", first.back(), "; there are ", total, " blocks"));
  for (int k = 0; k < total; ++k) place.push_back(in.count("an entry of the column index", 0, across - 1));
  for (int i = 0; i < down; ++i)
    for (int k = first[i]; k < first[i + 1]; ++k) {
      in.count("the number of a block", k, k);
      for (int c = column[place[k]]; c < column[place[k] + 1]; ++c)
        for (int r = row[i]; r < row[i + 1]; ++r)
          if (const double x = in.number("an entry of a block"); x != 0) entries.emplace_back(r, c, x);
    }
}

/// As CSparse prints it, to six digits: triplets "i j : x" or columns "col j : locations a to b" and "i : x".
void sparse(Numbers& in, int rows, int columns, Entries& entries) {
  const bool triplets = in.count("the sparse storage (1 triplets, 2 columns)", 1, 2) == 1;
  in.skip("CSparse");
  in.skip_line();
  if (triplets) in.skip("triplet:");
  in.skip(text(rows, "-by-", columns, ","));
  in.skip("nzmax:");
  in.count("the space for entries", 0, kMost);
  in.skip("nnz:");
  const int total = in.leading_count("the number of entries");
  in.skip_line();
  for (int j = -1, k = 0; k < total;) {
    if (!triplets && in.peek() == "col") {
      in.skip("col");
      j = in.count("the number of a column", j + 1, columns - 1);
      in.skip_line();
      continue;
    }
    const int i = in.count("the row of an entry", 0, rows - 1);
    if (triplets) j = in.count("the column of an entry", 0, columns - 1);
    if (j < 0) in.fail("an entry stands before the first column");
    in.skip(":");
    entries.emplace_back(i, j, in.number("an entry of a matrix"));
    ++k;
  }
  // Empty columns at the end are listed too.
  while (in.peek() == "col") {
    in.skip("col");
    in.skip_line();
  }
}

SparseMatrix matrix(Numbers& in) {
  const int storage = in.count("the storage of a matrix (0 dense, 1 blocks, 2 sparse)", 0, 2);
  const int rows = in.count("the number of rows", 0, kMost), columns = in.count("the number of columns", 0, kMost);
  in.require(std::max(rows, columns), "rows");  // each of them has a number in a vector behind the matrices
  Entries entries;
  (storage == 0 ? dense : storage == 1 ? blocks : sparse)(in, rows, columns, entries);
  SparseMatrix a(rows, columns);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

}  // namespace

ContactProblem read_text(const std::string& file) {
  Numbers in(file);
  ContactProblem p;
  p.name = file;
  const int dimension = in.count("the dimension of a contact problem", 2, 3);
  p.dimension = dimension;
  const int contacts = in.count("the number of contacts", 0, kMost / 3), rows = dimension * contacts;
  in.require(contacts, "contacts");
  const SparseMatrix first = matrix(in);
  if (first.rows() != first.cols()) in.fail(text("the first matrix is ", first.rows(), " x ", first.cols(), ", not square"));
  const int n = static_cast<int>(first.rows());
  const auto begins_H = [&](int storage) { return in.ahead({storage, n, rows}); };
  if (begins_H(0) || begins_H(1) || begins_H(2)) {
    p.kind = ContactProblem::Kind::global;
    p.M = first;
    p.H = matrix(in);
    p.f = in.vector("an entry of the vector f", n);
    p.w = in.vector("an entry of the vector w", rows);
  } else {
    if (n != rows)
      in.fail(text("the matrix has ", n, " rows: a local problem of ", contacts, " contacts has ", rows,
                   ", and in a global one the matrix H follows"));
    require_memory(8.0 * n * n, text("the dense matrix of ", n, " rows"));
    p.W = first;
    p.q = in.vector("an entry of the vector q", n);
  }
  p.mu = in.vector("a friction coefficient", contacts);
  // A flag may follow: whether there is a guess.
  if (const int left = in.words_left(); left > 1) in.fail(text(left, " words are left over after the friction coefficients"));
  return p;
}

}  // namespace dotyk::fclib

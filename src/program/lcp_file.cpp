#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/place.hpp"
#include "base/text.hpp"
#include "program/lcp.hpp"

namespace dotyk::program {
namespace {

class LcpReader {
 public:
  explicit LcpReader(const std::string& file) : file_(file) {
    require_readable(file);
    bytes_ = static_cast<double>(std::filesystem::file_size(file));
    in_.open(file);
  }

  Lcp read() {
    const int n = count("n", 1, 100000), storage = count("the storage", 0, 1);
    const int rows = count("the rows", n, n), columns = count("the columns", n, n);
    // A number takes two bytes at least.
    if (2.0 * n * (storage == 0 ? n : 1) > bytes_ + 1) throw InputError(text("'", file_, "': it is too short for a problem of ", n, " rows"));
    require_memory(16 * std::min(1.0 * n * n, bytes_ / 2), text("'", file_, "': the matrix of ", n, " rows"));
    Lcp lcp;
    if (storage == 0) dense(n);
    else blocks(n);
    lcp.M.resize(rows, columns);
    lcp.M.setFromTriplets(entries_.begin(), entries_.end(), [](double, double last) { return last; });
    lcp.M.prune(0.0);
    lcp.q.resize(n);
    for (double& x : lcp.q) x = number("q");
    lcp.name = std::filesystem::path(file_).filename();
    check(lcp);
    return lcp;
  }

 private:
  double number(const char* what) {
    double x;
    if (!(in_ >> x)) throw InputError(text("'", file_, "': a number of ", what, " is missing"));
    return x;
  }
  int count(const char* what, int least, double most) {
    const double x = number(what);
    if (!(x >= least && x <= most) || x != static_cast<int>(x))
      throw InputError(text("'", file_, "': ", what, " is ", x, "; from ", least, " to ", most, " is expected"));
    return static_cast<int>(x);
  }

  void dense(int n) {
    count("the rows of M", n, n), count("the columns of M", n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (const double value = number("M"); value != 0) entries_.emplace_back(i, j, value);
  }

  /// Blocks by compressed rows: their number, the blocks a side, the cumulated sizes, the two index arrays, and
  /// for each block its number and its entries by columns. Of blocks at one place the last counts.
  void blocks(int n) {
    const int total = count("the number of blocks", 1, std::min(static_cast<double>(n) * n, 1e9));
    const int down = count("the block rows", 1, n), across = count("the block columns", 1, n);
    const auto ends = [&](int size) {
      std::vector<int> list{0};
      for (int k = 0; k < size; ++k) list.push_back(count("a block's end", list.back() + 1, n));
      return list;
    };
    const std::vector<int> row = ends(down), column = ends(across);
    const int starts = count("the row index's length", down + 1, down + 1);
    const int filled = count("the column index's length", total, total);
    std::vector<int> first, place;
    for (int k = 0; k < starts; ++k)  // from 0 to the number of blocks, ascending
      first.push_back(count("the row index", k == 0 ? 0 : k == down ? total : first.back(), k == 0 ? 0 : total));
    for (int k = 0; k < filled; ++k) place.push_back(count("the column index", 0, across - 1));
    for (int k = 0, i = 0; k < total; ++k) {
      count("a block's number", k, k);
      while (first[i + 1] <= k) ++i;
      for (int c = column[place[k]]; c < column[place[k] + 1]; ++c)
        for (int r = row[i]; r < row[i + 1]; ++r) entries_.emplace_back(r, c, number("M"));
    }
  }

  std::string file_;
  std::ifstream in_;
  double bytes_ = 0;
  algebra::Triplets entries_;
};

}  // namespace

Lcp read_lcp(const std::string& file) { return LcpReader(file).read(); }

}  // namespace dotyk::program

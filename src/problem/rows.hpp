#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "problem/problem.hpp"
#include "problem/law_choice.hpp"

namespace dotyk::problem {

/// Gathers the rows of a problem as they come: entries of B and c, groups with their laws. Its blocks are there already.
class Rows {
 public:
  explicit Rows(Problem& problem) : problem_(problem) {}

  /// Rows added from now on are under this law.
  void open_group(std::string name, std::shared_ptr<const Law> law);
  /// Or under this one about v·unit, each for the share that it is added with, and with numbers of its own where it has them: see row_law().
  void open_group(std::string name, const LawChoice& law, double unit = 1);
  /// Rows added from now on are tangential, under a friction law of Problem::friction; returns the next row.
  int open_friction();
  /// Is the last group one of this name and this law?
  bool is_open(const std::string& name, const LawChoice& law) const { return open_ && problem_.groups.back().name == name && law_ == law; }

  /// An entry of the next row. One of several for the same unknown adds to them.
  void entry(int unknown, double value) { entries_.emplace_back(count(), unknown, value), any_ = true; }
  /// Has the next row an entry?
  bool any() const { return any_; }
  /// Ends a row x = Σ entries·u − c, even one without entries; returns its number.
  int add(double c, double share = 1, const LawChoice* own = nullptr);
  /// Such a row at once.
  int add(const std::vector<std::pair<int, double>>& entries, double c, double share = 1);
  int count() const { return static_cast<int>(c_.size()); }

  /// Sets B, c and how rows are named. Groups without rows are left out.
  void finish(std::function<std::string(int)> row_name);

 private:
  void close_group();

  Problem& problem_;
  bool open_ = false;    ///< rows belong to the last scalar group
  bool by_share_ = false, any_ = false;
  LawChoice law_;
  double unit_ = 1;
  std::vector<LawRow> law_rows_;
  std::vector<double> c_;
  algebra::Triplets entries_;
};

}  // namespace dotyk::problem

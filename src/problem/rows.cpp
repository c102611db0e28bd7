#include "problem/rows.hpp"

namespace dotyk::problem {

void Rows::open_group(std::string name, std::shared_ptr<const Law> law) {
  close_group();
  problem_.groups.push_back({std::move(name), std::move(law), count(), 0});
  open_ = true;
}

void Rows::open_group(std::string name, const LawChoice& law, double unit) {
  open_group(std::move(name), nullptr);
  by_share_ = true, law_ = law, unit_ = unit;
}

int Rows::open_friction() {
  close_group();
  return count();
}

int Rows::add(double c, double share, const LawChoice* own) {
  if (open_) ++problem_.groups.back().count, law_rows_.push_back({own ? *own : law_, share});
  any_ = false;
  c_.push_back(c);
  return count() - 1;
}

int Rows::add(const std::vector<std::pair<int, double>>& entries, double c, double share) {
  for (const auto& [unknown, value] : entries) entry(unknown, value);
  return add(c, share);
}

void Rows::close_group() {
  if (open_ && law_rows_.empty()) problem_.groups.pop_back();
  else if (open_ && by_share_) problem_.groups.back().law = row_law(law_rows_, unit_);
  law_rows_.clear();
  open_ = by_share_ = false;
}

void Rows::finish(std::function<std::string(int)> row_name) {
  close_group();
  problem_.B = algebra::from_triplets<algebra::SparseRows>(count(), problem_.unknowns(), entries_);
  problem_.c = Eigen::Map<const algebra::Vector>(c_.data(), count());
  problem_.row_name = std::move(row_name);
}

}  // namespace dotyk::problem

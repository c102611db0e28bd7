#include "contact/partition.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dotyk::contact {
namespace {

using mesh::Box;

class Cutter {
 public:
  Cutter(const std::vector<Piece>& pieces, double size) : pieces_(pieces), size_(size), cell_(pieces.size(), -1) {}

  /// Cuts what of these pieces lies in `within`.
  void cut(const std::vector<int>& list, const Box& within) {
    const Box box = around(list, within);
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (box.extent(i) > (1 + 1e-9) * box.extent(axis)) axis = i;
    const double extent = box.extent(axis);
    const int slabs = std::min(static_cast<int>(list.size()), static_cast<int>(std::ceil(extent / size_ - 1e-6)));
    if (slabs <= 1) {
      for (const int p : list) cell_[p] = count_;
      ++count_;
      return;
    }
    std::vector<std::vector<int>> slab(slabs);
    for (const int p : list) {
      const int k = static_cast<int>(std::floor((pieces_[p].centre[axis] - box.low[axis]) / extent * slabs));
      slab[std::clamp(k, 0, slabs - 1)].push_back(p);
    }
    for (int k = 0; k < slabs; ++k) {
      if (slab[k].empty()) continue;
      Box part = box;
      part.low[axis] = box.low[axis] + extent * k / slabs;
      part.high[axis] = box.low[axis] + extent * (k + 1) / slabs;
      cut(slab[k], part);
    }
  }

  std::vector<int> take() { return std::move(cell_); }

 private:
  Box around(const std::vector<int>& list, const Box& within) const {
    Box box;
    for (const int p : list) box.add(pieces_[p].box);
    for (int i = 0; i < 3; ++i) {
      box.low[i] = std::max(box.low[i], within.low[i]);
      box.high[i] = std::max(box.low[i], std::min(box.high[i], within.high[i]));
    }
    return box;
  }

  const std::vector<Piece>& pieces_;
  double size_;
  std::vector<int> cell_;
  int count_ = 0;
};

}  // namespace

std::vector<int> partition(const std::vector<Piece>& pieces, double size) {
  std::map<int, std::vector<int>> by_component;
  for (std::size_t p = 0; p < pieces.size(); ++p) by_component[pieces[p].component].push_back(static_cast<int>(p));
  Cutter cutter(pieces, size);
  constexpr Box kSpace{{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
  for (const auto& [component, list] : by_component) cutter.cut(list, kSpace);
  return cutter.take();
}

}  // namespace dotyk::contact

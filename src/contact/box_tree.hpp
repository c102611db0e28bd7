#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/point.hpp"

namespace dotyk::contact {

using mesh::Box;

/// All places within `radius` of a line.
class Tube {
 public:
  /// `axes`: unit, perpendicular to the line and to each other; in the plane the second is 0.
  Tube(const mesh::Point& on_line, const std::array<mesh::Point, 2>& axes, double radius) : on_line_(on_line), axes_(axes), radius_(radius) {}
  /// False only where the tube and the box have no point in common (they are apart along one of the axes).
  bool meets(const Box& box) const {
    for (const mesh::Point& axis : axes_) {
      double middle = 0, half = 0;
      for (int i = 0; i < 3; ++i) {
        middle += axis[i] * ((box.low[i] + box.high[i]) / 2 - on_line_[i]);
        half += std::abs(axis[i]) * (box.high[i] - box.low[i]) / 2;
      }
      if (std::abs(middle) > (1 + 1e-6) * (half + radius_)) return false;
    }
    return true;
  }

 private:
  mesh::Point on_line_;
  std::array<mesh::Point, 2> axes_;
  double radius_;
};

/// Boxes in a binary tree, each node of which knows the box around those below it: halves by the middles of boxes, along
/// the longest way. n log n to make; boxes of very different sizes cost no more.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    for (std::size_t k = 0; k < boxes_.size(); ++k) order_.push_back(static_cast<int>(k));
    if (!order_.empty()) split(0, static_cast<int>(order_.size()));
  }

  /// The numbers of the boxes that `meets` accepts, ascending. `meets` must accept a box that holds one it accepts.
  template <class Meets>
  std::vector<int> find(Meets&& meets) const {
    std::vector<int> found;
    if (!nodes_.empty()) visit(0, meets, found);
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr int kLeaf = 8;
  struct Node {
    Box box;
    int first, last;  ///< of order_
    int right;        ///< the second child; the first follows the node. 0: a leaf
  };

  void split(int first, int last) {
    const std::size_t self = nodes_.size();
    Node node{{}, first, last, 0};
    Box middles;
    for (int k = first; k < last; ++k) node.box.add(boxes_[order_[k]]), middles.add(middle(order_[k]));
    nodes_.push_back(node);
    if (last - first <= kLeaf) return;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (middles.high[i] - middles.low[i] > middles.high[axis] - middles.low[axis]) axis = i;
    const int half = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                     [&](int a, int b) { return middle(a)[axis] < middle(b)[axis]; });
    split(first, half);
    nodes_[self].right = static_cast<int>(nodes_.size());
    split(half, last);
  }

  mesh::Point middle(int k) const { return mesh::times(0.5, mesh::plus(boxes_[k].low, boxes_[k].high)); }

  template <class Meets>
  void visit(int at, Meets& meets, std::vector<int>& found) const {
    const Node& node = nodes_[at];
    if (!meets(node.box)) return;
    if (node.right > 0) {
      visit(at + 1, meets, found);
      visit(node.right, meets, found);
      return;
    }
    for (int k = node.first; k < node.last; ++k)
      if (meets(boxes_[order_[k]])) found.push_back(order_[k]);
  }

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace dotyk::contact

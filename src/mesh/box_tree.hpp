#pragma once

#include <algorithm>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

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

  /// The numbers of the boxes that hold x, ascending.
  std::vector<int> around(const Point& x) const {
    return find([&](const Box& box) { return box.holds(x); });
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

  Point middle(int k) const { return times(0.5, plus(boxes_[k].low, boxes_[k].high)); }

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

/// The boxes of a mesh's cells, each a little larger: around(x) has every cell that x is in, or beside by less than 1e-6 of
/// the mesh's size, and none far from it.
inline BoxTree boxes_of_cells(const Mesh& mesh) {
  const double margin = 1e-6 * mesh.size();
  std::vector<Box> boxes(mesh.cell_count());
  for (int c = 0; c < mesh.cell_count(); ++c) {
    Box& box = boxes[c];
    for (int k = 0; k < nodes_of(mesh.element); ++k) box.add(mesh.point(mesh.cell(c)[k]));
    // A curved side bulges beyond its nodes, by less than half its height.
    for (int i = 0; mesh.topology().order == 2 && i < 3; ++i) {
      const double bulge = box.extent(i) / 4;
      box.low[i] -= bulge, box.high[i] += bulge;
    }
    box.grow(margin);
  }
  return BoxTree(std::move(boxes));
}

}  // namespace dotyk::mesh

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// What a round of refinement made of a mesh.
struct Refined {
  std::vector<int> parent;                ///< cell → the cell before that it lies in
  std::vector<std::array<int, 2>> ends;   ///< of each new node (numbered after the old ones): the nodes it lies midway between
};

/// A conforming mesh of simplices that is refined by bisection, locally and as often as wanted, with the marks that
/// keep its cells from degenerating.
///
/// A cell is bisected through the midpoint of its refinement edge and the nodes not on it. At first that is the
/// longest edge, equal lengths told apart by direction (so that meshes that match on a surface still do). Afterwards:
/// triangles: newest vertex bisection, the edge opposite the new node (Mitchell 1988), at most 4 shapes from one
/// triangle; tetrahedra: each face has a marked edge, too, by the rules of Arnold, Mukherjee and Pouly (SIAM J. Sci.
/// Comput. 22, 2000, algorithm BisectTet), a bounded number of shapes from any conforming mesh. Cells with a
/// hanging node are bisected until none is left; that ends. Old nodes keep their numbers.
class Bisection {
 public:
  /// Throws InputError where the cells are not simplices.
  explicit Bisection(std::shared_ptr<const Mesh> start);
  explicit Bisection(const Mesh& start) : Bisection(std::make_shared<const Mesh>(start)) {}

  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

  /// Moves the nodes that the last round made on the boundary part to `map(x)`: without it, new nodes of a curved
  /// boundary stay on its chords. Throws InputError where the mesh has no such part, a cell inverts, or `map`
  /// itself changed these meshes, and then moves none.
  void project(const std::string& part, const std::function<Point(const Point&)>& map);

 private:
  friend class Rounds;
  struct Cell {
    std::array<int, 4> node;
    std::array<int, 4> tag;                          ///< of the facet opposite a node: which parts it is of
    std::array<std::uint8_t, 2> edge;                ///< refinement edge, local nodes
    std::array<std::array<std::uint8_t, 2>, 4> face; ///< tetrahedra: marked edge of the face opposite a node
    bool flag = false;                               ///< tetrahedra: from a planar parent
    std::uint8_t wanted = 0;                         ///< bisections asked for in this round
    int parent = -1;
  };

  void mark(Cell& cell) const;
  bool longer(int a, int b, int c, int d) const;
  bool planar(const Cell& cell) const;
  int midpoint(int a, int b);
  bool hangs(const Cell& cell) const;
  void bisect(int c);
  Cell child(const Cell& cell, int kept, int replaced, int node) const;
  void begin(const std::vector<int>& cells);
  bool close(Monitor& monitor);
  Refined end(Monitor& monitor);

  int dim_;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<Cell> cells_;
  std::vector<std::vector<int>> tags_;  ///< parts of each tag, by their place in names_; the first has none
  std::vector<std::string> names_;
  std::vector<double> coordinates_;
  std::unordered_map<std::uint64_t, int> split_;  ///< edge → its midpoint, of this round
  std::vector<std::array<int, 2>> ends_;
  int first_new_ = 0;
};

/// Nodes of two meshes that must go on matching: surfaces in contact or glued.
struct Joint {
  int first, second;                      ///< which meshes; may be one
  std::vector<std::pair<int, int>> nodes; ///< of the first and of the second
};

/// A round for several meshes at once: bisects cells[m] of mesh m (ascending or not, repeated or not) `dimension` times, which halves their extent, and
/// others as conformity needs. What is bisected on one side of a joint is on the other. Facets of boundary parts hand their name down.
/// Throws InputError for a cell out of range, Interrupted where the monitor asks to stop; whatever it throws, the meshes
/// are as they were.
std::vector<Refined> refine(const std::vector<Bisection*>& meshes, const std::vector<std::vector<int>>& cells,
                            const std::vector<Joint>& joints, Monitor& monitor);

}  // namespace dotyk::mesh

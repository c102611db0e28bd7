#pragma once

#include "base/text.hpp"
#include "chain.hpp"
#include "elastic.hpp"

namespace dotyk::test {

/// An elastic body of a problem that is to be cut into pieces.
struct CutBody {
  Mesh mesh;
  std::function<bool(const Point&, int)> held = [](const Point&, int) { return false; };
  VectorField value = [](const Point&) { return Point{0, 0, 0}; };  ///< of what is held
  VectorField load = [](const Point&) { return Point{0, 0, 0}; };   ///< force per volume
  std::function<int(const Point&)> piece = [](const Point&) { return 0; };  ///< 0, 1, … of a cell by its centre
  bool support_rows = true;
  double young = 210;
};

struct Assembled {
  System system;
  Numbering numbering;
  elasticity::RigidModes rigid;
};

inline Assembled assembled(const Mesh& m, const CutBody& body, bool hold) {
  const Numbering numbering = hold ? prescribe(m, body.held, body.value) : all_free(m);
  std::vector<double> force(m.coordinates.size(), 0);
  elasticity::add_body_force(m, body.load, force);
  return {system_of(m, steel(m.dimension(), body.young), {}, force, numbering), numbering, elasticity::rigid_modes(m, numbering, {})};
}

/// The cells of a piece with their nodes, in the order of the whole mesh; `node`: which those are.
inline Mesh cells_of(const CutBody& body, int piece, std::vector<int>& node) {
  const Mesh& whole = body.mesh;
  const int per_cell = whole.topology().nodes;
  std::vector<int> number(whole.node_count(), -1), cells;
  for (int c = 0; c < whole.cell_count(); ++c)
    if (body.piece(whole.cell_centre(c)) == piece)
      for (int a = 0; a < per_cell; ++a) {
        cells.push_back(whole.cell(c)[a]);
        number[whole.cell(c)[a]] = 0;
      }
  Mesh m;
  m.element = whole.element;
  node.clear();
  for (int n = 0; n < whole.node_count(); ++n)
    if (number[n] == 0) {
      number[n] = static_cast<int>(node.size());
      node.push_back(n);
      m.coordinates.insert(m.coordinates.end(), whole.node(n), whole.node(n) + whole.dimension());
    }
  for (int n : cells) m.cells.push_back(number[n]);
  return m;
}

/// Adds the body as a block, and its pieces; returns the numbering of the whole body's unknowns (from 0).
inline Numbering add(problem::Problem& p, const CutBody& body) {
  const Assembled whole = assembled(body.mesh, body, true);
  const int index = static_cast<int>(p.blocks.size()), dim = body.mesh.dimension();
  problem::Block block;
  block.name = text("body ", index + 1);
  block.K = whole.system.K;
  block.f = whole.system.f;
  block.offset = whole.system.offset;
  block.node = whole.numbering.node;
  block.kernel = whole.rigid.modes;
  block.motions = whole.rigid.motions;
  problem::add(p, block);
  int pieces = 0;
  for (int c = 0; c < body.mesh.cell_count(); ++c)
    pieces = std::max(pieces, body.piece(body.mesh.cell_centre(c)) + 1);
  for (int k = 0; k < pieces; ++k) {
    std::vector<int> node;
    const Mesh m = cells_of(body, k, node);
    const Assembled part = assembled(m, body, !body.support_rows);
    problem::Subdomain s;
    s.block = index;
    s.stiffness = std::make_shared<const problem::Stiffness>(problem::Stiffness{part.system.K, part.rigid.modes});
    s.f = part.system.f;
    s.value = algebra::Vector::Zero(s.size());
    for (int n = 0; n < m.node_count(); ++n)
      for (int i = 0; i < dim; ++i) {
        const int own = part.numbering.unknown[n * dim + i], unknown = whole.numbering.unknown[node[n] * dim + i];
        if (own < 0) continue;
        s.node.push_back(node[n]);
        s.unknown.push_back(unknown < 0 ? -1 : p.blocks.back().first + unknown);
        if (unknown < 0) s.value[own] = whole.numbering.value(node[n] * dim + i);
      }
    p.subdomains.push_back(std::move(s));
  }
  return whole.numbering;
}

/// Which of `count` equal parts of [0, length] along each axis holds a point, numbered with x fastest.
inline std::function<int(const Point&)> boxes(std::array<int, 3> count, Point length) {
  return [=](const Point& x) {
    int index = 0;
    for (int i = 2; i >= 0; --i)
      index = index * count[i] + (length[i] > 0 ? std::min(count[i] - 1, static_cast<int>(x[i] / length[i] * count[i])) : 0);
    return index;
  };
}

/// Adds a row (u_i of a node) − c under a law for each node that `chosen` accepts where component i is unknown.
inline void add_rows(problem::Problem& p, const CutBody& body, const Numbering& numbering, int component, double sign,
                     const std::function<bool(const Point&)>& chosen, double gap) {
  const int dim = body.mesh.dimension(), old = p.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < old; ++r)
    for (algebra::SparseRows::InnerIterator it(p.B, r); it; ++it) entries.emplace_back(r, static_cast<int>(it.col()), it.value());
  int row = old;
  for (int n = 0; n < body.mesh.node_count(); ++n)
    if (numbering.unknown[n * dim + component] >= 0 && chosen(body.mesh.point(n)))
      entries.emplace_back(row++, p.blocks.back().first + numbering.unknown[n * dim + component], sign);
  p.B.resize(row, p.unknowns());
  p.B.setFromTriplets(entries.begin(), entries.end());
  p.c.conservativeResize(row);
  p.c.tail(row - old).setConstant(gap);
  p.groups.push_back(group(problem::unilateral(), old, row - old));
}

}  // namespace dotyk::test

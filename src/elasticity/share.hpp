#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "algebra/types.hpp"
#include "base/lists.hpp"
#include "elasticity/assembly.hpp"
#include "elasticity/load.hpp"

namespace dotyk::elasticity {

/// The cells that have a node with a flagged unknown, and so many more `layers` − 1 about them, their material, force and supports: assemble_share() takes the lists
/// after joined(). `own`: a flag for each unknown of the body; `body`: its number.
Share share(const mesh::Mesh& mesh, const MaterialField& material, const LinearForce& force, const Numbering& numbering, const std::vector<char>& own, int body = 0,
            int layers = 1);

/// Combines the shares of several bodies into one share.
Share joined(std::vector<Share> of_bodies);

/// The lower triangle of the stiffness of these cells, from the lists of joined(). In rows and columns of flagged unknowns its entries are those of the bodies'
/// stiffness.
algebra::StoredMatrix assemble_share(Lists lists);
/// One body's cells of a share.
struct ShareCells {
  int body = 0;  ///< its number
  mesh::Mesh mesh;
  MaterialField material;
  LinearForce force;
  std::vector<char> fixed;  ///< node × dimension
};

/// The cells of a share that are refined first; supports of the share are not used.
class RefinableShare final : public algebra::Refinable {
 public:
  explicit RefinableShare(std::vector<ShareCells> bodies) : bodies_(std::move(bodies)) {}

  Buckets refine() override;
  std::vector<int> keep(const std::vector<char>& flagged, int layers) override;
  Assembled assemble(const std::vector<char>& fixed) override;
  const std::vector<ShareCells>& bodies() const { return bodies_; }

 private:
  std::vector<double> load() const;

  std::vector<ShareCells> bodies_;
};

/// From the same lists.
std::unique_ptr<algebra::Refinable> refinable_share(Lists lists);

}  // namespace dotyk::elasticity

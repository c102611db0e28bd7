#include "scene/model/nearly_free.hpp"

#include "algebra/congruent.hpp"
#include "base/listed.hpp"
#include "elasticity/rigid_modes.hpp"

namespace dotyk::scene {
namespace {

using elasticity::Numbering;

/// The springs of a body that ranks refine, as stiffness of its coarse mesh.
algebra::SparseMatrix spring_stiffness(const Body& body, const Numbering& numbering, const std::vector<algebra::CoarseFunctions>& functions, const Numbering& coarse) {
  algebra::SparseMatrix S = algebra::from_triplets(numbering.count(), numbering.count(), elasticity::spring_stiffness(*body.mesh, body.facet_springs(), numbering));
  for (const algebra::CoarseFunctions& level : functions) {
    algebra::SparseRows P;
    level.to_matrix(P);
    S = algebra::congruent(S, P);
  }
  std::vector<int> unknown(static_cast<std::size_t>(S.rows()), -1);  // of each column of the last functions; held nodes have none
  for (std::size_t k = 0; k < coarse.unknown.size(); ++k)
    if (const int column = functions.back().column[k]; column >= 0) unknown[column] = coarse.unknown[k];
  algebra::Triplets entries;
  for (int j = 0; j < S.cols(); ++j)
    for (algebra::SparseMatrix::InnerIterator it(S, j); it; ++it)
      if (const int row = std::max(unknown[it.row()], unknown[j]), column = std::min(unknown[it.row()], unknown[j]); column >= 0) entries.emplace_back(row, column, it.value());
  return algebra::from_triplets(coarse.count(), coarse.count(), entries);
}

/// Of the coarse mesh of a body that ranks refine, held at all nodes whose functions meet a support: a support smaller than coarse cells counts as great as these.
elasticity::WeakMotions weak_motions_before_refining(const Body& body, const Numbering& numbering, const problem::Block& block) {
  const Unrefined& before = *body.unrefined;
  const std::vector<algebra::CoarseFunctions> functions = block.coarse.functions(before.times);
  std::vector<char> fixed;
  for (const int row : functions[0].row) fixed.push_back(row < 0);
  for (const algebra::CoarseFunctions& level : functions) {
    std::vector<char> coarse(level.column.size(), 0);
    const int d = level.dimension;
    for (int node = 0; node < level.nodes(); ++node)
      for (const int p : level.of(node))
        for (int k = 0; k < d; ++k) coarse[d * p + k] |= fixed[d * node + k];
    fixed.swap(coarse);
  }
  const Numbering coarse = elasticity::number(*before.mesh, fixed, {});
  const std::vector<elasticity::FacetSpring> springs = body.facet_springs();
  const auto stiffness = [&]() -> algebra::SymmetricMatrix {
    algebra::StoredMatrix K = elasticity::assemble(*before.mesh, before.material, {}, coarse);
    return springs.empty() ? std::move(K) : algebra::lower_sum(K, spring_stiffness(body, numbering, functions, coarse));
  };
  const elasticity::RigidModes rigid = elasticity::rigid_modes(*before.mesh, coarse, springs, body.mesh.get());
  if (rigid.modes.cols() > 0) problem::require_kernel(stiffness(), rigid.modes, "'" + body.name + "'", rigid.motions);
  return elasticity::weak_motions(*before.mesh, before.material, {*body.mesh, numbering, springs}, coarse, stiffness, rigid.modes);
}

}  // namespace

std::string supports_of(const Body& body) {
  static const char* kind[] = {"fix of ", "slide on ", "displacement of "};
  std::vector<std::string> all;
  for (const Support& s : body.supports)
    all.push_back(text(kind[static_cast<int>(s.kind)], s.part.name, " (", s.nodes.size(),
                       s.nodes.size() == 1 ? " node)" : " nodes)"));
  for (std::size_t k = 0; k < body.springs.size(); ++k)
    if (k == 0 || !(body.springs[k].part == body.springs[k - 1].part))
      all.push_back("spring on " + body.springs[k].part.name);
  return listed(all, 4);
}

elasticity::WeakMotions weak_motions(const Model& model, std::size_t b) {
  const Body& body = model.bodies[b];
  const problem::Block& block = model.problem.blocks[b];
  if (body.unrefined) return weak_motions_before_refining(body, model.numbering[b], block);
  return elasticity::weak_motions(*body.mesh, body.material, {*body.mesh, model.numbering[b], model.springs_in_stiffness(b)}, model.numbering[b],
                                  [&] { return block.K; }, block.kernel);
}

std::vector<std::string> describe_nearly_free(const Scene& scene, const Model& model) {
  constexpr std::size_t most = 3;
  std::vector<std::string> all;
  for (std::size_t b = 0; b < model.nearly_free.size(); ++b)
    if (!model.nearly_free[b].empty()) all.push_back("'" + scene.bodies[b]->name + "' is " + model.nearly_free[b]);
  if (all.size() <= most) return all;
  const std::string others = text(all.size() - most, " more bodies are nearly free");
  all.resize(most);
  all.push_back(others);
  return all;
}

}  // namespace dotyk::scene

#include "scene/model/slices.hpp"

#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>

#include "base/error.hpp"
#include "base/listed.hpp"
#include "problem/coarser.hpp"

namespace dotyk::scene {

bool refined_by_ranks(const Model& model) {
  double all = 0;
  for (const problem::Block& block : model.problem.blocks) all += block.size() + static_cast<double>(block.hidden);
  if (all > std::numeric_limits<int>::max()) throw InputError(text("the scene has ", all, " unknowns; at most ", std::numeric_limits<int>::max(), " can be numbered"));
  const auto times = [](const Body& body) { return body.unrefined ? body.unrefined->times : 0; };
  const Body& first = model.bodies.front();
  for (const Body& body : model.bodies)
    if (times(body) != times(first))
      throw InputError(text("'", first.name, "' has refine = ", times(first), ", '", body.name, "' refine = ", times(body),
                            " (0: it was made before there were several ranks, or without): on several ranks all bodies of a scene have the "
                            "same"));
  return times(first) > 0;
}

namespace {

constexpr multigrid::ShareMakers kMakers{elasticity::assemble_share, elasticity::refinable_share};

/// What the ranks get of a body.
struct Source {
  const mesh::Mesh& mesh;
  const elasticity::MaterialField& material;
  const elasticity::LinearForce& force;
  const elasticity::Numbering& numbering;
  int first;  ///< unknown, among those of all bodies
};

/// What a rank makes the flagged rows from.
Share share_of_all(const std::vector<Source>& sources, const std::vector<char>& own, int layers = 1) {
  std::vector<Share> of_bodies;
  for (std::size_t b = 0; b < sources.size(); ++b) {
    const Source& source = sources[b];
    const auto begin = own.begin() + source.first;
    const std::vector<char> of_body(begin, begin + source.numbering.count());
    if (std::ranges::none_of(of_body, [](char flag) { return flag; })) continue;
    of_bodies.push_back(elasticity::share(source.mesh, source.material, source.force, source.numbering, of_body, static_cast<int>(b), layers));
    for (int& unknown : of_bodies.back().unknowns) unknown += source.first;
  }
  return elasticity::joined(std::move(of_bodies));
}

/// Calls visit(unknown, unknown) for pairs of nodes of a cell, one unknown of each.
void each_pair_of_cells(const std::vector<Source>& sources, const std::function<void(int, int)>& visit) {
  for (const Source& source : sources) {
    const mesh::Mesh& mesh = source.mesh;
    std::vector<int> unknown(static_cast<std::size_t>(mesh.node_count()), -1);  // of each node
    for (int i = 0; i < source.numbering.count(); ++i) unknown[source.numbering.node[i]] = source.first + i;
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int k = 0; k < mesh::nodes_of(mesh.element); ++k)
        for (int l = 0; l < k; ++l)
          if (const int i = unknown[mesh.cell(c)[k]], j = unknown[mesh.cell(c)[l]]; i >= 0 && j >= 0) visit(i, j);
  }
}

/// For each row of B an unknown of each coarse node that the row's unknowns follow. `coarse`: the functions that lead to the coarse bodies.
algebra::SparseRows rows_of_coarse(const Model& model, std::span<const algebra::CoarseFunctions> coarse) {
  const problem::Problem& problem = model.problem;
  const int d = coarse.front().dimension;
  std::vector<int> first{0};  // node of each body
  for (const Body& body : model.bodies) first.push_back(first.back() + body.mesh->node_count());
  algebra::Triplets entries;
  for (int r = 0; r < problem.rows(); ++r)
    for (algebra::SparseRows::InnerIterator it(problem.B, r); it; ++it) {
      const std::size_t b = problem.block_of(it.col());
      int node = first[b] + problem.blocks[b].node[it.col() - problem.blocks[b].first];
      for (const algebra::CoarseFunctions& functions : coarse) node = functions.of(node)[0];
      entries.emplace_back(r, d * node, 1);
    }
  return algebra::from_triplets<algebra::SparseRows>(problem.rows(), d * coarse.back().coarse_nodes(), entries);
}

/// Of all components of the coarse bodies' nodes.
std::vector<elasticity::Numbering> coarse_numbering(const Model& model) {
  std::vector<elasticity::Numbering> numbering;
  for (const Body& body : model.bodies) numbering.push_back(elasticity::number(*body.unrefined->mesh, std::vector<char>(body.unrefined->mesh->coordinates.size(), 0), {}));
  return numbering;
}

std::vector<Source> coarse_sources(const Model& model, const std::vector<elasticity::Numbering>& numbering) {
  std::vector<Source> sources;
  for (std::size_t b = 0, first = 0; b < numbering.size(); first += static_cast<std::size_t>(numbering[b].count()), ++b) {
    const Unrefined& before = *model.bodies[b].unrefined;
    sources.push_back({*before.mesh, before.material, before.force, numbering[b], static_cast<int>(first)});
  }
  return sources;
}

/// K after the ranks have refined the bodies, all of them so many times.
std::shared_ptr<const algebra::SlicedMatrix> refined_slices(const Model& model, const std::vector<algebra::CoarseFunctions>& functions, const algebra::Triplets& springs, int times) {
  if (std::ssize(functions) < times) throw std::logic_error("bodies refined by the ranks, whose coarser meshes are not known");
  const std::vector<elasticity::Numbering> numbering = coarse_numbering(model);
  const std::vector<Source> sources = coarse_sources(model, numbering);
  const int d = functions.front().dimension, components = d * functions[times - 1].coarse_nodes();
  std::vector<int> all(static_cast<std::size_t>(components)), node;
  std::iota(all.begin(), all.end(), 0);
  for (const int component : all) node.push_back(component / d);
  std::vector<algebra::CoarseFunctions> of_coarse(functions.begin() + times, functions.end());
  if (!of_coarse.empty()) of_coarse.front().row = all, of_coarse.front().rows = components;
  const algebra::SparseRows rows = rows_of_coarse(model, std::span(functions).first(static_cast<std::size_t>(times)));
  const bool loaded = std::ranges::any_of(model.bodies, [](const Body& body) { return body.volume_load.has_value(); });
  constexpr int kCoupled = 4;  // times the work at nodes that rows couple, on the finest mesh
  const multigrid::Coupling coupling{node, of_coarse, rows, [&](const auto& visit) { each_pair_of_cells(sources, visit); }, 1 + (kCoupled >> times)};
  return multigrid::make_refined_slices({{coupling, [&](const std::vector<char>& own) { return share_of_all(sources, own); }, kMakers, springs}, times, functions, loaded});
}

}  // namespace

void assemble_slices(Model& model) {
  problem::Problem& problem = model.problem;
  const std::vector<algebra::CoarseFunctions> functions = problem::coarse_functions(problem);
  algebra::Triplets springs;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (const auto& e : elasticity::spring_stiffness(*model.bodies[b].mesh, model.bodies[b].facet_springs(), model.numbering[b]))
      springs.emplace_back(problem.blocks[b].first + e.row(), problem.blocks[b].first + e.col(), e.value());
  if (const auto& coarse = model.bodies.front().unrefined) return take_slices(problem, refined_slices(model, functions, springs, coarse->times));
  const elasticity::LinearForce none;
  std::vector<Source> sources;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    sources.push_back({*model.bodies[b].mesh, model.bodies[b].material, none, model.numbering[b], problem.blocks[b].first});
  const std::vector<int> nodes = problem::nodes(problem);
  const multigrid::Coupling coupling{nodes, functions, problem.B, [&](const auto& visit) { each_pair_of_cells(sources, visit); }};
  take_slices(problem, multigrid::make_slices({coupling, [&](const std::vector<char>& own) { return share_of_all(sources, own); }, kMakers, springs}));
}

std::vector<Lists> visit_refined(const Model& model, const problem::Displacement& u, multigrid::VisitFor what, multigrid::VisitCells make, Lists said, std::vector<int> nodes) {
  if (!u.there()) throw InputError("the displacement inside bodies with refine, which the ranks had, is known no more");
  const std::vector<elasticity::Numbering> numbering = coarse_numbering(model);
  const std::vector<Source> sources = coarse_sources(model, numbering);
  std::vector<int> components;
  std::vector<double> values;
  int first = 0;
  for (std::size_t b = 0; b < model.bodies.size(); first += static_cast<int>(model.numbering[b].unknown.size()), ++b)
    for (std::size_t k = 0; k < model.numbering[b].unknown.size(); ++k)
      if (const double value = model.numbering[b].value(k); model.numbering[b].unknown[k] < 0 && value != 0) components.push_back(first + static_cast<int>(k)), values.push_back(value);
  return multigrid::visit({[&](const std::vector<char>& own) { return share_of_all(sources, own, multigrid::VisitedCells::kLayers); }, kMakers, what, make, *u.there(),
                                    std::move(components), std::move(values), std::move(said), std::move(nodes)});
}

}  // namespace dotyk::scene

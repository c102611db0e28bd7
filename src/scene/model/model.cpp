#include "scene/model/model.hpp"

#include <algorithm>
#include <cmath>

#include "base/listed.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "elasticity/refined.hpp"
#include "elasticity/rigid_modes.hpp"
#include "problem/coarser.hpp"
#include "problem/contradiction.hpp"
#include "scene/model/nearly_free.hpp"
#include "scene/model/row_builder.hpp"
#include "scene/model/slices.hpp"
#include "scene/model/subdomains.hpp"

namespace dotyk::scene {
namespace {

using elasticity::Numbering;
using mesh::Mesh;
using mesh::Point;

/// f and the offset for the body's prescribed components as they are now.
void set_load(Model& model, std::size_t b) {
  const Body& body = model.bodies[b];
  const Numbering& numbering = model.numbering[b];
  problem::Block& block = model.problem.blocks[b];
  auto load = elasticity::load(*body.mesh, body.material, model.springs_in_stiffness(b), body.force, numbering);
  block.f = std::move(load.f);
  block.offset = load.offset + broken_energy(body);
  if (model.springs_are_rows[b]) block.offset += elasticity::spring_rows(*body.mesh, body.facet_springs(), numbering).offset;
  if (!body.unrefined) return;
  const std::vector<double> given = volume_forces(body);
  for (std::size_t k = 0; k < given.size(); ++k) block.offset -= numbering.value(k) * given[k];
}

/// Sets how many times the load that the slices have counts: all loads per volume have one factor.
void take_sliced_load(Model& model) {
  model.problem.sliced_load = 0;
  for (const Body& body : model.bodies)
    if (body.unrefined && body.volume_load) model.problem.sliced_load = body.volume_load->factor;
  problem::take_load_of_slices(model.problem);
}

algebra::StoredMatrix assemble(const Model& model, std::size_t b) {
  const Body& body = model.bodies[b];
  require_memory(2 * elasticity::matrix_bytes(*body.mesh), "the stiffness of '" + body.name + "'");  // and as much while it is made
  return elasticity::assemble(*body.mesh, body.material, model.springs_in_stiffness(b), model.numbering[b]);
}

/// The motions that K of a body does not resist, and what they are.
void set_kernel(Model& model, std::size_t b) {
  const Body& body = model.bodies[b];
  auto rigid = elasticity::rigid_modes(*body.mesh, model.numbering[b], model.springs_in_stiffness(b));
  model.problem.blocks[b].kernel = std::move(rigid.modes);
  model.problem.blocks[b].motions = std::move(rigid.motions);
}

/// Puts springs that alone, and hardly, hold a motion of the body into rows, where `movable`. Sets the body's entry of Model::nearly_free and lowers `softest`.
void see_weak_motions(Model& model, std::size_t b, bool movable) {
  const Body& body = model.bodies[b];
  elasticity::WeakMotions weak = weak_motions(model, b);
  model.nearly_free.emplace_back();
  if (weak.motions.empty()) return;
  const std::string motions = listed(texts(weak.motions)), holds = supports_of(body);
  model.nearly_free.back() = text("nearly free: ", motions, "; without contact held only by ", holds, ", ", weak.stiffness > 0 ? text(weak.stiffness) : "1e-15 or less", " as stiff as the body");
  if (movable && !body.springs.empty()) {
    model.springs_are_rows[b] = 1;
    model.problem.blocks[b].K = assemble(model, b);
    set_kernel(model, b);
    set_load(model, b);
    weak = weak_motions(model, b);
  }
  if (weak.motions.empty()) return;
  model.softest = std::min(model.softest, weak.stiffness);
  if (weak.stiffness == 0)
    throw InputError(text("'", body.name, "' is as good as free: ", motions, " is held only by ", holds,
                          ", whose stiffness is lost in rounding beside the body's; leave that away, or make it stiffer"));
}

/// What Block::about() tells: where a node is; and of cells there that are long and thin, how much.
std::pair<std::string, std::string> about(const Mesh& mesh, int node) {
  constexpr double kSlender = 100;
  const Buckets cells = mesh::cells_of_nodes(mesh);
  double most = 0;
  for (const int cell : cells[node]) {
    double extent = 0;
    for (int a = 0; a < mesh.topology().nodes; ++a) extent = std::max(extent, mesh::length(mesh::minus(mesh.point(mesh.cell(cell)[a]), mesh.point(mesh.cell(cell)[0]))));
    most = std::max(most, std::pow(extent, mesh.dimension()) / mesh::least_jacobian(mesh, cell));
  }
  return {" at " + point_text(mesh.node(node), mesh.dimension()),
          most < kSlender ? "" : text("cells there are some ", std::round(most), " times as long as they are thick, and rounding takes their stiffness against bending; "
                                      "take more cells along the body, at most some ", kSlender, " times as long as thick, or dotyk.beam or dotyk.plate")};
}

/// A block that is not assembled yet.
void add_body(const Body& body, Model& model) {
  model.numbering.push_back(number(body));
  const Numbering& numbering = model.numbering.back();
  model.springs_are_rows.push_back(0);
  auto rigid = elasticity::rigid_modes(*body.mesh, numbering, body.facet_springs());
  problem::Block block;
  block.name = body.name;
  block.f = algebra::Vector::Zero(numbering.count());
  block.node = numbering.node;
  if (body.unrefined && body.volume_load && rigid.modes.cols() > 0) {
    const auto [e, gross] = elasticity::resultants(*body.unrefined->mesh, body.unrefined->times, body.unrefined->force, rigid);
    block.sliced_resultants = e, block.gross_sliced_resultants = gross;
  }
  block.kernel = std::move(rigid.modes);
  block.motions = std::move(rigid.motions);
  block.motions.sum = [frame = rigid.frame, modes = std::move(rigid.coefficients)](const algebra::Vector& amounts) { return frame.motion(modes * amounts, 1e-6, true); };
  const SharedList<int>& unknown = numbering.unknown;
  block.rigid = [mesh = body.mesh, unknown, count = numbering.count()] { return elasticity::all_rigid_motions(*mesh, unknown, count); };
  if (!body.unrefined) block.about = [mesh = body.mesh](int node) { return about(*mesh, node); };
  block.coarse = {mesh::coarser_nodes(*body.mesh), body.mesh->dimension(), [mesh = body.mesh, unknown, count = numbering.count()](int levels) {
                    return elasticity::coarse_functions(*mesh, unknown, count, levels);
                  }, body.mesh->topology().order};
  if (body.unrefined) {
    block.hidden = body.hidden_components();
    block.coarse.rigid = [base = body.unrefined, functions = block.coarse.functions](int levels) {
      const std::vector<algebra::CoarseFunctions> coarse = functions(levels);
      if (levels < base->times) {
        mesh::Mesh between;
        between.element = base->mesh->element, between.coordinates = base->between[static_cast<std::size_t>(levels) - 1];
        return elasticity::all_rigid_motions(between, coarse.back().column, coarse.back().columns);
      }
      algebra::DenseMatrix motions = elasticity::all_rigid_motions(*base->mesh, coarse[base->times - 1].column, coarse[base->times - 1].columns);
      for (int level = base->times; level < levels; ++level) motions = coarse[level].at_coarse(motions);
      return motions;
    };
  }
  block.first = model.problem.unknowns();
  model.problem.blocks.push_back(std::move(block));
}

void add_glue_rows(const Scene& scene, const Contact& contact, const FreeJumps& jumps, RowBuilder& builder) {
  const int first = scene.index_of(contact.first.body.get());
  const int second = scene.index_of(contact.second.body.get());
  builder.rows.open_group(contact.name, problem::bilateral());
  for (const contact::Tie& tie : contact.glued) {
    const auto require_together = [&](double apart) {
      if (!(apart > 1e-12 * contact.first.body->mesh->size())) return;
      throw InputError(text(contact.name, ": at ", point_text(contact.first.body->mesh->node(tie.node), scene.dimension()),
                            " the two sides are prescribed displacements that differ by ", apart));
    };
    require_together(jumps.torn(tie));
    for (const Point& direction : jumps.at(tie)) {
      double jump = 0;
      if (builder.add(first, second, {{tie.own, tie.partners, direction}}, jump) < 0) require_together(std::abs(jump));
    }
  }
}

}  // namespace

std::vector<double> spread(const Numbering& numbering, const algebra::Vector& x, std::vector<double> rest) {
  for (std::size_t k = 0; k < rest.size(); ++k)
    if (numbering.unknown[k] >= 0) rest[k] = x[numbering.unknown[k]];
  return rest;
}

std::vector<elasticity::FacetSpring> Model::springs_in_stiffness(std::size_t body) const {
  return springs_are_rows[body] ? std::vector<elasticity::FacetSpring>() : bodies[body].facet_springs();
}

std::vector<double> Model::displacement(int body, const algebra::Vector& u) const {
  return spread(numbering[body], u.segment(problem.blocks[body].first, numbering[body].count()), numbering[body].values());
}

namespace {

/// Refuses an interference, or prescribed displacements, that other contacts or supports leave no way out of.
void require_consistent(const Scene& scene, const problem::Problem& problem) {
  double size = 0;
  for (const auto& body : scene.bodies) size = std::max(size, body->mesh->size());
  const auto found = problem::contradiction(problem, 1e-9 * size);
  if (!found) return;
  const std::vector<const problem::RowGroup*> group = problem.group_of_rows();
  std::vector<std::string> others;
  for (const int r : found->others) others.push_back(text(group[r]->name, " at ", problem.row_name(r)));
  throw InputError(text(group[found->row]->name, ": ", problem.row_name(found->row), group[found->row]->law->unilateral() ? text(" lies ", found->by, " inside the other side") : text(" is ", found->by, " off"),
                        ", and others hold it there (", listed(others, 3), "): no displacement can part them; leave one away, or make the interference or the prescribed displacement less"));
}

/// All rows anew, for the prescribed displacements and moves as they are now.
void set_rows(const Scene& scene, const Loading& loading, Model& model) {
  model.problem.groups.clear();
  model.problem.friction.clear();
  static_cast<SceneRows&>(model) = {};
  RowBuilder builder(scene, model);
  for (const auto& given : scene.contacts) {
    const FreeJumps jumps(scene, model.bodies, model.numbering, *given);
    const auto contact = model.contacts.emplace_back(loading.applied_to(with_held_normals(given, jumps)));
    model.move.push_back(loading.move_of(static_cast<int>(model.move.size())));
    builder.set_move(model.move.back());
    model.contact_row.emplace_back();
    model.normal.emplace_back();
    model.friction.emplace_back();
    if (contact->kind == Contact::Kind::contact) add_contact_rows(scene, *contact, jumps, builder, model);
    else add_glue_rows(scene, *contact, jumps, builder);
  }
  builder.set_move({0, 0, 0});
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    model.slide_row.emplace_back();
    add_support_rows(static_cast<int>(b), builder, model);
    const Body& body = model.bodies[b];
    if (model.springs_are_rows[b]) builder.add(static_cast<int>(b), elasticity::spring_rows(*body.mesh, body.facet_springs(), model.numbering[b]));
    if (body.slides.empty()) continue;
    builder.rows.open_group("slide of '" + body.name + "'", problem::bilateral());
    for (const SlideRow& slide : body.slides) {
      double jump = 0;
      model.slide_row.back().push_back(builder.add(static_cast<int>(b), {{slide.node, 1}}, slide.normal, jump));
      const mesh::Mesh& mesh = *body.mesh;
      if (model.slide_row.back().back() < 0 && std::abs(jump) > 1e-12 * mesh.size())
        throw InputError(text("contradictory supports on '", body.name, "': at the node ",
                              point_text(mesh.node(slide.node), mesh.dimension()), " part '", slide.part.name,
                              "' slides, but its displacement along the normal is prescribed to be ", -jump));
    }
  }
  builder.finish();
  require_consistent(scene, model.problem);
}

void require_moderate(const problem::Problem& problem, bool cut) {
  if (cut) problem::require_moderate(problem, problem::kMostForceOnSubdomains);
  else if (problem.rows() > 0) problem::require_moderate(problem, problem::kMostForceOnRows);
}

}  // namespace

Model build(const Scene& scene, problem::Clock& clock, Monitor& monitor, const Loading& loading,
            const std::optional<problem::Decomposition>& decomposition, const std::function<bool(const problem::Problem&)>& slices) {
  Stopwatch watch;
  Model model;
  for (const auto& body : scene.bodies) {
    model.bodies.push_back(loading.applied_to(*body));
    add_body(model.bodies.back(), model);
  }
  monitor.check();
  set_rows(scene, loading, model);
  const int unknowns = model.problem.all_unknowns();
  const bool refined = refined_by_ranks(model);
  constexpr std::size_t kMostBodies = 100;  // what is asked of one body takes a product of all
  const bool in_slices = slices && (refined || (scene.bodies.size() <= kMostBodies && multigrid::slices_pay_for(unknowns))) && slices(model.problem) && (refined || multigrid::starts());
  if (refined && !in_slices) throw InputError("the stiffness of bodies with refine is with the ranks: dotyk.solver.multigrid{} works there, which dotyk.solve takes by itself; anything else needs one rank");
  if (in_slices) monitor.phase(text("assembling (", unknowns, " unknowns)")), assemble_slices(model);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = model.bodies[b];
    problem::Block& block = model.problem.blocks[b];
    if (!in_slices) {
      monitor.phase(text("assembling '", body.name, "' (", body.mesh->cell_count(), " cells)"));
      block.K = assemble(model, b);
    }
    set_load(model, b);
    if (!body.unrefined) problem::require_kernel(block.K, block.kernel, "'" + block.name + "'", block.motions);
    see_weak_motions(model, b, !in_slices && !decomposition && !body.unrefined);
    monitor.check();
  }
  if (std::ranges::count(model.springs_are_rows, 1) > 0) set_rows(scene, loading, model);
  take_sliced_load(model);
  require_moderate(model.problem, decomposition.has_value());
  if (decomposition) cut(*decomposition, model, monitor);
  clock.assembly += watch.seconds();
  return model;
}

void reload(const Scene& scene, const std::vector<Body>& bodies, const Loading& loading, Model& model,
            problem::Clock& clock) {
  Stopwatch watch;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    model.bodies[b] = loading.applied_to(bodies[b]);
    model.numbering[b] = number(model.bodies[b]);
    set_load(model, b);
  }
  take_sliced_load(model);
  set_rows(scene, loading, model);
  require_moderate(model.problem, model.decomposition.has_value());
  load_subdomains(model);
  clock.assembly += watch.seconds();
}

}  // namespace dotyk::scene

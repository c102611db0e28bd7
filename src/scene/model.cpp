#include "scene/model.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "elasticity/rigid_modes.hpp"

namespace dotyk::scene {
namespace {

using elasticity::Numbering;
using mesh::Point;

/// Where a row is, for messages made only when needed.
struct RowPlace {
  int body, node;
};

/// Gathers rows of B as they come.
class RowBuilder {
 public:
  RowBuilder(const Scene& scene, Model& model) : scene_(scene), model_(model) {}

  void open_group(const std::string& name, std::shared_ptr<const problem::Law> law) {
    model_.problem.groups.push_back({name, std::move(law), count_, 0});
  }

  /// Σ ± direction·u at one or two nodes = jump; returns the row, or -1 where nothing is unknown.
  /// `gap` is reduced by what prescribed components contribute and left so.
  int add(int body, int node, int other_body, int other_node, const Point& direction, double& gap) {
    const std::size_t before = entries_.size();
    collect(body, node, direction, 1, gap);
    if (other_body >= 0) collect(other_body, other_node, direction, -1, gap);
    if (entries_.size() == before) return -1;
    gaps_.push_back(gap);
    places_.push_back({body, node});
    ++model_.problem.groups.back().count;
    return count_++;
  }

  void finish() {
    model_.problem.B.resize(count_, model_.problem.unknowns());
    model_.problem.B.setFromTriplets(entries_.begin(), entries_.end());
    model_.problem.c = Eigen::Map<const algebra::Vector>(gaps_.data(), count_);
    std::vector<std::string> names;
    for (const auto& body : scene_.bodies) names.push_back(body->name);
    std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
    for (const auto& body : scene_.bodies) meshes.push_back(body->mesh);
    model_.problem.row_name = [names, meshes, places = places_](int row) {
      const RowPlace p = places[row];
      return text("node ", p.node + 1, " of '", names[p.body], "' at ",
                  point_text(meshes[p.body]->node(p.node), meshes[p.body]->dimension()));
    };
  }

 private:
  void collect(int body, int node, const Point& direction, double sign, double& gap) {
    const int dim = scene_.dimension();
    const Numbering& numbering = model_.numbering[body];
    for (int i = 0; i < dim; ++i) {
      if (direction[i] == 0) continue;
      const std::size_t at = static_cast<std::size_t>(node) * dim + i;
      if (numbering.unknown[at] >= 0)
        entries_.emplace_back(count_, model_.problem.blocks[body].first + numbering.unknown[at],
                              sign * direction[i]);
      else
        gap -= sign * direction[i] * numbering.prescribed[at];
    }
  }

  const Scene& scene_;
  Model& model_;
  int count_ = 0;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> gaps_;
  std::vector<RowPlace> places_;
};

/// Bytes of a lower triangle with as many couplings as a grid of these cells has.
double matrix_bytes(const mesh::Mesh& mesh) {
  const double dim = mesh.dimension(), neighbours = dim == 2 ? (mesh.topology().nodes == 3 ? 7 : 9)
                                                             : (mesh.topology().nodes == 4 ? 15 : 27);
  return 12 * 0.5 * mesh.node_count() * dim * (dim * neighbours + 1);
}

void add_body(const Body& body, Model& model) {
  require_memory(2 * matrix_bytes(*body.mesh), "the stiffness of '" + body.name + "'");  // and as much while it is made
  model.numbering.push_back(number(body));
  const Numbering& numbering = model.numbering.back();
  const auto springs = body.facet_springs();
  auto system = elasticity::assemble(*body.mesh, body.material, springs, body.force, numbering);
  auto rigid = elasticity::rigid_modes(*body.mesh, numbering, springs);
  problem::Block block;
  block.name = body.name;
  block.K = std::move(system.K);
  block.f = std::move(system.f);
  block.offset = system.offset;
  block.node = numbering.node;
  block.kernel = std::move(rigid.modes);
  block.kernel_names = std::move(rigid.names);
  problem::add(model.problem, std::move(block));
}

void add_contact_rows(const Scene& scene, const Contact& contact, RowBuilder& builder,
                      std::vector<int>& row_of) {
  const int first = scene.index_of(contact.first.body.get());
  const int second = scene.index_of(contact.second.body.get());
  const double size = contact.first.body->mesh->size();
  builder.open_group(contact.name, problem::unilateral());
  for (const contact::ContactRow& row : contact.rows) {
    double gap = row.gap;
    row_of.push_back(builder.add(first, row.node, second, row.partner, row.normal, gap));
    // Rounding of coordinates may leave a fixed node this far inside.
    if (row_of.back() < 0 && gap < -1e-9 * size)
      throw InputError(text(contact.name, ": the node at ",
                            point_text(contact.first.body->mesh->node(row.node), scene.dimension()),
                            " is fixed in the normal direction and lies ", -gap,
                            " inside the other side; no displacement can part them"));
  }
}

void add_glue_rows(const Scene& scene, const Contact& contact, RowBuilder& builder,
                   std::vector<int>& row_of) {
  const int first = scene.index_of(contact.first.body.get());
  const int second = scene.index_of(contact.second.body.get());
  builder.open_group(contact.name, problem::bilateral());
  for (const contact::NodePair& pair : contact.glued)
    for (int i = 0; i < scene.dimension(); ++i) {
      Point direction{0, 0, 0};
      direction[i] = 1;
      double jump = 0;
      row_of.push_back(builder.add(first, pair.first, second, pair.second, direction, jump));
      if (row_of.back() < 0 && std::abs(jump) > 1e-12 * contact.first.body->mesh->size())
        throw InputError(text(contact.name, ": at ",
                              point_text(contact.first.body->mesh->node(pair.first), scene.dimension()),
                              " the two sides are prescribed displacements that differ by ", std::abs(jump)));
    }
}

}  // namespace

std::vector<double> Model::displacement(int body, const algebra::Vector& u) const {
  std::vector<double> result = numbering[body].prescribed;
  for (std::size_t k = 0; k < result.size(); ++k)
    if (numbering[body].unknown[k] >= 0)
      result[k] = u[problem.blocks[body].first + numbering[body].unknown[k]];
  return result;
}

Model build(const Scene& scene, problem::Clock& clock, Monitor& monitor) {
  Stopwatch watch;
  Model model;
  for (const auto& body : scene.bodies) {
    monitor.phase(text("assembling '", body->name, "' (", body->mesh->cell_count(), " cells)"));
    model.bodies.push_back(*body);
    add_body(model.bodies.back(), model);
    monitor.check();
  }
  RowBuilder builder(scene, model);
  for (const auto& contact : scene.contacts) {
    model.contact_row.emplace_back();
    model.glue_row.emplace_back();
    if (contact->kind == Contact::Kind::contact)
      add_contact_rows(scene, *contact, builder, model.contact_row.back());
    else
      add_glue_rows(scene, *contact, builder, model.glue_row.back());
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    model.slide_row.emplace_back();
    const Body& body = model.bodies[b];
    if (body.slides.empty()) continue;
    builder.open_group("slide of '" + body.name + "'", problem::bilateral());
    for (const SlideRow& slide : body.slides) {
      double jump = 0;
      model.slide_row.back().push_back(
          builder.add(static_cast<int>(b), slide.node, -1, -1, slide.normal, jump));
      const mesh::Mesh& mesh = *body.mesh;
      if (model.slide_row.back().back() < 0 && std::abs(jump) > 1e-12 * mesh.size())
        throw InputError(text("contradictory supports on '", body.name, "': at the node ",
                              point_text(mesh.node(slide.node), mesh.dimension()), " part '", slide.part.name,
                              "' slides, but its displacement along the normal is prescribed to be ", -jump));
    }
  }
  builder.finish();
  clock.assembly += watch.seconds();
  return model;
}

}  // namespace dotyk::scene

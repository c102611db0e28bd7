#include "figure/compose/compose.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "figure/compose/outline.hpp"
#include "figure/scene/contact_map.hpp"
#include "mesh/second_order.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::figure {
namespace {

using scene::Body;
using scene::Contact;
using scene::Solution;

using elasticity::Stress;

// What a field is called, and its value of the displacement and the stress at a node.
struct SceneValue {
  const char* label;
  double (*value)(const Vec3& u, const Stress& s);
};

template <int i>
double displacement(const Vec3& u, const Stress&) { return u[i]; }
template <int i>
double stress(const Vec3&, const Stress& s) { return s[i]; }

const SceneValue& field_of(FieldChoice choice) {
  static const SceneValue fields[] = {{"", nullptr},
                                 {"displacement", [](const Vec3& u, const Stress&) { return std::hypot(u[0], u[1], u[2]); }},
                                 {"displacement along x", displacement<0>}, {"displacement along y", displacement<1>}, {"displacement along z", displacement<2>},
                                 {"von Mises stress", [](const Vec3&, const Stress& s) { return elasticity::von_mises(s); }},
                                 {"stress xx", stress<0>}, {"stress yy", stress<1>}, {"stress zz", stress<2>},
                                 {"stress yz", stress<3>}, {"stress xz", stress<4>}, {"stress xy", stress<5>}, {"error indicator", nullptr},
                                 {"contact pressure", nullptr}, {"gap", nullptr}, {"slip", nullptr}, {"", nullptr}};
  return fields[static_cast<int>(choice)];
}

const char* key_of(FieldChoice choice) { return field_names()[static_cast<std::size_t>(choice)].first; }

bool is_stress(FieldChoice field) { return field >= FieldChoice::von_mises && field <= FieldChoice::xy; }

/// √ of each cell's share of the square of the estimate, for each of the pieces that cells of order 2 are cut into.
std::vector<double> error_indicators(const Solution& s, int index, int cells) {
  const auto& shares = s.error_estimate().cells[index];
  const int pieces = cells / static_cast<int>(shares.size());
  std::vector<double> out;
  for (int c = 0; c < cells; ++c) out.push_back(std::sqrt(std::max(0.0, shares[c / pieces].sum())));
  return out;
}

/// The edges of cells of order 2 (in space of the facets drawn, as others are behind), cut in two at their nodes.
std::vector<int> second_order_edges(const mesh::Mesh& mesh) {
  const mesh::ElementTopology& t = mesh.topology();
  std::vector<int> edges;
  const auto add = [&](int from, int middle, int to) { edges.insert(edges.end(), {from, middle, middle, to}); };
  if (t.dimension == 2)
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int l = 0; l < t.facets; ++l) add(mesh.facet_node({c, l}, 0), mesh.facet_node({c, l}, 2), mesh.facet_node({c, l}, 1));
  else
    for (const mesh::Facet f : mesh::boundary(mesh))
      for (int k = 0; k < t.facet_corners; ++k)
        add(mesh.facet_node(f, k), mesh.facet_node(f, t.facet_corners + k), mesh.facet_node(f, (k + 1) % t.facet_corners));
  return edges;
}

BodyPicture body_picture(const Solution& s, int index, const SceneOptions& options) {
  const FieldChoice field = options.field;
  const Body& body = s.body(index);
  const mesh::Mesh mesh = mesh::cut_at_nodes(*body.mesh);
  const int dim = body.dimension();
  BodyPicture picture;
  picture.name = body.name;
  picture.dimension = dim;
  picture.shape = cell_shape(mesh);
  picture.cells = mesh.cells;
  picture.nodes_per_facet = mesh.topology().nodes_per_facet;
  if (body.mesh->topology().order == 2) picture.edges = second_order_edges(*body.mesh);
  for (const mesh::Facet f : mesh::boundary(mesh)) {
    for (int k = 0; k < picture.nodes_per_facet; ++k) picture.facets.push_back(mesh.facet_node(f, k));
    if (field == FieldChoice::error) picture.facet_cells.push_back(f.cell);
  }
  const auto& u = s.displacement(index);
  for (int n = 0; n < mesh.node_count(); ++n) {
    const Vec3 x = mesh.point(n), d = mesh::at_node(u, n, dim);
    picture.points.insert(picture.points.end(), x.begin(), x.end());
    picture.displacement.insert(picture.displacement.end(), d.begin(), d.end());
  }
  if (options.trajectories)
    for (const Stress& at_node : s.stress(index)) picture.stress.insert(picture.stress.end(), {at_node[0], at_node[1], at_node[5]});
  if (field == FieldChoice::error) picture.cell_values = error_indicators(s, index, mesh.cell_count());
  if (!field_of(field).value) return picture;
  for (int n = 0; n < mesh.node_count(); ++n)
    picture.values.push_back(field_of(field).value(mesh::at_node(u, n, dim), is_stress(field) ? s.stress(index)[n] : Stress{}));
  if (mesh.whole) {  // what is not seen, and not well known, does not stretch the colours
    std::vector<char> seen(picture.values.size(), 0);
    for (const int node : picture.facets) seen[node] = 1;
    for (std::size_t n = 0; n < seen.size(); ++n)
      if (!seen[n]) picture.values[n] = picture.values[picture.facets[0]];
  }
  return picture;
}

/// Laws, by the nearest of the known symbols: rollers for a rigid base, else springs; none where the support is broken.
void add_law_supports(const Solution& s, int index, int& along, ScenePicture& picture) {
  const Body& body = s.body(index);
  for (const scene::LawSupport& on : body.laws) {
    const Outline outline(*body.mesh, on.facets, along);
    const auto result = s.support({s.scene().bodies[index], on.part.name, on.facets});
    const problem::LawAlong& law = on.normal->acts() ? on.normal : on.tangential;
    if (law->load) continue;
    for (const scene::SupportNode& node : result.nodes)
      if (!node.broken)
        picture.supports.push_back({node.x, mesh::at_node(s.displacement(index), node.node, body.dimension()), node.normal, {true, true, true},
                                    law->stop() || law->prescribes ? SupportKind::slide : SupportKind::spring, node.status == problem::Status::open && on.normal->acts(),
                                    outline.of(node.node)});
  }
}

void add_supports(const Solution& s, int index, int& along, ScenePicture& picture) {
  const Body& body = s.body(index);
  const auto& u = s.displacement(index);
  const int dim = body.dimension();
  for (const scene::Support& support : body.supports) {
    const Outline outline(*body.mesh, support.facets, along);
    for (std::size_t k = 0; k < support.nodes.size(); ++k)
      picture.supports.push_back({body.mesh->point(support.nodes[k]), mesh::at_node(u, support.nodes[k], dim),
                                  support.normals[k], support.components[k], static_cast<SupportKind>(support.kind), false, outline.of(support.nodes[k])});
  }
  std::set<mesh::Facet> sliding;
  for (const scene::SlideRow& slide : body.slides) sliding.insert(slide.facets->begin(), slide.facets->end());
  const Outline slides(*body.mesh, {sliding.begin(), sliding.end()}, along);
  for (const scene::SlideRow& slide : body.slides)
    picture.supports.push_back({body.mesh->point(slide.node), mesh::at_node(u, slide.node, dim), slide.normal,
                                {true, true, true}, SupportKind::slide, false, slides.of(slide.node)});
  std::vector<mesh::Facet> sprung;
  for (const scene::SpringPatch& patch : body.springs) sprung.push_back(patch.spring.facet);
  const Outline springs(*body.mesh, sprung, along);
  for (const scene::SpringPatch& patch : body.springs) {
    const mesh::Point centre = body.mesh->facet_centre(patch.spring.facet);
    const Vec3 normal = mesh::unit(body.mesh->facet_area_vector(patch.spring.facet));
    const auto& k = patch.spring.stiffness.front();
    picture.supports.push_back({centre, s.displacement(index, centre), normal,
                                {k[0] > 0, k[1] > 0, k[2] > 0}, SupportKind::spring, false, springs.of(patch.spring.facet)});
  }
  add_law_supports(s, index, along, picture);
}

void add_loads(const Solution& s, int index, int& along, ScenePicture& picture) {
  const Body& body = s.body(index);
  const std::vector<scene::LoadArrow> arrows = scene::load_arrows(body);
  std::vector<mesh::Facet> loaded;
  for (const scene::LoadArrow& arrow : arrows) loaded.push_back(arrow.facet);
  const Outline outline(*body.mesh, loaded, along);
  const std::size_t step = body.dimension() == 2 ? 1 : std::max<std::size_t>(1, arrows.size() / 200);
  for (std::size_t k = 0; k < arrows.size(); k += step)
    picture.loads.push_back({arrows[k].at, s.displacement(index, arrows[k].at), arrows[k].value, mesh::unit(body.mesh->facet_area_vector(arrows[k].facet)), outline.of(arrows[k].facet)});
}

/// A field that is zero but for rounding is drawn as zero: one below 1e-9 of the greatest stress or displacement in the scene.
void drop_rounding(const Solution& s, FieldChoice field, ScenePicture& picture) {
  constexpr double kRounding = 1e-9;
  double reference = 0, most = 0;
  for (int b = 0; b < static_cast<int>(s.scene().bodies.size()); ++b) {
    if (!is_stress(field)) reference = std::max(reference, greatest(s.displacement(b)));
    else
      for (const Stress& at_node : s.stress(b)) reference = std::max(reference, greatest(at_node));
  }
  std::vector<std::vector<double>*> fields;
  for (BodyPicture& body : picture.bodies) fields.push_back(&body.values);
  for (ContactPicture& contact : picture.contacts) fields.push_back(&contact.values);
  for (const auto* values : fields)
    for (const double v : *values)
      if (std::isfinite(v)) most = std::max(most, std::abs(v));
  if (most < kRounding * reference)
    for (auto* values : fields)
      for (double& v : *values)
        if (std::isfinite(v)) v = 0;
}

double scene_size(const Solution& s) {
  mesh::Box box;
  for (const auto& body : s.scene().bodies) box.add(body->mesh->box());
  return std::max({box.extent(0), box.extent(1), box.extent(2)});
}

/// The greatest factor at which bodies that moved into a gap are drawn overlapping by no more than 1 % of
/// the scene's size, and those that an interference presses apart no further apart than that: between bodies
/// the gap at rest is not magnified, the way is.
double gap_limit(const Solution& s, double size) {
  double limit = INFINITY;
  for (const auto& contact : s.scene().contacts) {
    if (contact->kind != Contact::Kind::contact || !contact->second.body) continue;
    const scene::ContactResult result = s.contact(*contact);
    for (std::size_t k = 0; k < contact->rows.size(); ++k) {
      const double gap = contact->rows[k].gap, way = gap - result.nodes[k].gap;
      if (gap > 0 && way > 0) limit = std::min(limit, (gap + 0.01 * size) / way);
      if (gap < 0 && result.nodes[k].status != problem::Status::open) limit = std::min(limit, 1 - 0.01 * size / gap);
    }
  }
  return limit;
}

void refuse_missing(FieldChoice field, int dimension) {
  if (dimension != 2) return;
  if (field == FieldChoice::uz || field == FieldChoice::yz || field == FieldChoice::xz)
    throw InputError(std::string("field ") + field_of(field).label + " does not exist: the scene is 2-D");
  if (of_contacts(field)) throw InputError(std::string("field \"") + key_of(field) + "\" is one of contacts, which are for scenes in space; this one is 2-D, where status and pressure are drawn at the contact line");
}

/// How far each body moves from the middle of all.
std::vector<Vec3> explosion(const Solution& s, double share) {
  std::vector<Vec3> centres;
  Vec3 middle{0, 0, 0};
  for (const auto& body : s.scene().bodies) {
    const mesh::Box box = body->mesh->box();
    centres.push_back(part_way(box.low, box.high, 0.5));
    middle = plus(middle, centres.back(), 1.0 / static_cast<double>(s.scene().bodies.size()));
  }
  for (Vec3& centre : centres) centre = plus({0, 0, 0}, plus(centre, middle, -1), share);
  return centres;
}

void move(std::vector<double>& points, const Vec3& by) {
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += by[i % 3];
}

}  // namespace

CellShape cell_shape(const mesh::Mesh& mesh) {
  const mesh::ElementTopology& t = mesh.topology();
  if (t.dimension == 2) return t.facets == 3 ? CellShape::triangle : CellShape::quad;
  return t.facets == 4 ? CellShape::tetrahedron : CellShape::hexahedron;
}

const std::vector<std::pair<const char*, FieldChoice>>& field_names() {
  using F = FieldChoice;
  static const std::vector<std::pair<const char*, F>> names{
      {"none", F::none}, {"displacement", F::displacement}, {"ux", F::ux}, {"uy", F::uy}, {"uz", F::uz}, {"von_mises", F::von_mises},
      {"xx", F::xx}, {"yy", F::yy}, {"zz", F::zz}, {"yz", F::yz}, {"xz", F::xz}, {"xy", F::xy},
      {"error", F::error}, {"pressure", F::pressure}, {"gap", F::gap}, {"slip", F::slip}, {"status", F::status}};
  return names;
}

double visible_deformation(const Solution& s) {
  double largest = 0;
  for (std::size_t b = 0; b < s.scene().bodies.size(); ++b)
    largest = std::max(largest, greatest(s.displacement(static_cast<int>(b))));
  if (!(largest > 0)) return 1;
  const double size = scene_size(s), below = 1 - 1e-9;  // round numbers of a scene give round ratios, whose rounding must not decide
  const double wanted = below * std::min(0.1 * size / largest, gap_limit(s, size));
  return wanted <= 1 ? 1 : round_number_below(wanted);
}

ScenePicture compose(const Solution& s, const SceneOptions& options) {
  const int dim = s.scene().dimension();
  refuse_missing(options.field, dim);
  if (dim == 2) scene::require_whole(s.scene(), "a picture in the plane");
  if (dim == 2 && options.explode > 0) throw InputError("'explode' is for scenes in space; this one is 2-D");
  if (dim == 3 && options.trajectories) throw InputError("'trajectories' is for scenes in the plane; this one is in space");
  ScenePicture picture;
  picture.caption = solver::doubt(s.result());
  picture.field_label = field_of(options.field).label;
  picture.field_signed = options.field != FieldChoice::displacement && options.field != FieldChoice::von_mises && options.field < FieldChoice::error;
  picture.deformation = options.deform.value_or(visible_deformation(s));
  picture.trajectories = options.trajectories;
  const std::vector<Vec3> moves = explosion(s, options.explode);
  int along = 0;
  for (int b = 0; b < static_cast<int>(s.scene().bodies.size()); ++b) {
    const std::size_t supports = picture.supports.size(), loads = picture.loads.size();
    picture.bodies.push_back(body_picture(s, b, options));
    if (options.supports) add_supports(s, b, along, picture);
    if (options.loads) add_loads(s, b, along, picture);
    if (options.explode == 0) continue;
    move(picture.bodies.back().points, moves[b]);
    for (std::size_t i = supports; i < picture.supports.size(); ++i) picture.supports[i].position = plus(picture.supports[i].position, moves[b]);
    for (std::size_t i = loads; i < picture.loads.size(); ++i) picture.loads[i].position = plus(picture.loads[i].position, moves[b]);
  }
  std::ranges::stable_sort(picture.supports, {}, &SupportSymbol::place);
  std::ranges::stable_sort(picture.loads, {}, &LoadArrow::place);
  if (options.contact) add_contacts(s, options, moves, scene_size(s), picture);
  if (of_contacts(options.field) && picture.contacts.empty())
    throw InputError(std::string("field \"") + key_of(options.field) + "\" is one of contacts; " + (options.contact ? "this scene has none" : "with 'contact' false none is drawn"));
  if (options.field != FieldChoice::pressure && options.field != FieldChoice::error && options.field != FieldChoice::none) drop_rounding(s, options.field, picture);
  return picture;
}

ScenePicture compose_map(const Solution& s, const Contact& contact, FieldChoice field) {
  if (s.scene().dimension() == 2) throw InputError("'map' is for contacts in space; this scene is 2-D");
  if (contact.kind != Contact::Kind::contact) throw InputError("'map' is for contacts; this is a glue");
  if (!of_contacts(field)) throw InputError(std::string("a map shows a field of the contact: \"pressure\", \"gap\", \"slip\" or \"status\", not the field \"") + key_of(field) + "\"");
  ContactPicture shown = contact_picture(contact, s.contact(contact), s.displacement(s.scene().index_of(contact.first.body.get())));
  shown.values = contact_values(shown, field);
  ScenePicture picture = contact_map(shown);
  picture.field_label = field_of(field).label;
  picture.caption = solver::doubt(s.result());
  if (field == FieldChoice::gap || field == FieldChoice::slip) drop_rounding(s, field, picture);
  return picture;
}

void name_units(ScenePicture& picture, FieldChoice field, const SceneUnits& units) {
  picture.length_unit = units.length, picture.pressure_unit = units.stress, picture.load_unit = units.load;
  const bool length = field == FieldChoice::gap || field == FieldChoice::slip || (field >= FieldChoice::displacement && field <= FieldChoice::uz);
  picture.field_unit = length ? units.length : is_stress(field) || field == FieldChoice::pressure ? units.stress : "";
}

}  // namespace dotyk::figure

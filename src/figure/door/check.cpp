#include <cstdio>

#include "base/whole_file.hpp"
#include "figure/canvas/window.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

std::string box_text(const std::array<double, 4>& b) {
  char out[128];
  std::snprintf(out, sizeof out, "{%.4g, %.4g, %.4g, %.4g}", b[0], b[1], b[2], b[3]);
  return out;
}

/// Without code points that stand for no character, which cairo refuses in the middle of a picture.
bool is_utf8(const std::string& words) {
  const auto* at = reinterpret_cast<const unsigned char*>(words.data());
  const unsigned char* const end = at + words.size();
  while (at < end) {
    const int first = *at++, more = first < 0x80 ? 0 : first >= 0xc2 && first < 0xe0 ? 1 : first >= 0xe0 && first < 0xf0 ? 2 : first >= 0xf0 && first < 0xf5 ? 3 : -1;
    if (more < 0 || end - at < more) return false;
    static constexpr int mask[] = {0x7f, 0x1f, 0x0f, 0x07}, least[] = {0, 0x80, 0x800, 0x10000};
    int point = first & mask[more];
    for (int k = 0; k < more; ++k, ++at) {
      if ((*at & 0xc0) != 0x80) return false;
      point = point << 6 | (*at & 0x3f);
    }
    if (point < least[more] || point > 0x10ffff || (point >= 0xd800 && point < 0xe000) || (point & 0xfffe) == 0xfffe || (point >= 0xfdd0 && point <= 0xfdef)) return false;
  }
  return true;
}

// `endings` with their dots; `words`: the same in words.
void check_file(const std::string& file, std::initializer_list<const char*> endings, const std::string& words) {
  require(!file.empty(), "a file name is needed, one that ends in " + words);
  const std::string name = file.substr(file.rfind('/') + 1);
  require(std::ranges::any_of(endings, [&](const std::string& ending) { return name.size() > ending.size() && name.ends_with(ending); }), "cannot write ", file,
          ": the file name must end in ", words);
  place_to_write(file);
}

void check_nodes(const std::vector<int>& nodes, int each, std::size_t n, const std::string& what) {
  require(nodes.size() % each == 0, what, ": ", nodes.size(), " entries are not a multiple of ", each);
  const auto wrong = std::find_if(nodes.begin(), nodes.end(), [n](int i) { return i < 0 || static_cast<std::size_t>(i) >= n; });
  if (wrong != nodes.end()) require(false, what, ": node ", *wrong, " does not exist, there are ", n);
}

// Given for `each` of n nodes, or not at all.
void check_count(const std::vector<double>& given, std::size_t n, const std::string& who, const char* what, std::size_t each = 1) {
  require(given.empty() || given.size() == each * n, who, ": ", given.size(), " ", what, " for ", n, " nodes");
}

// Its ends, and how far they are apart.
bool is_range(const std::array<double, 2>& range) { return range[0] < range[1] && std::isfinite(range[1] - range[0]); }

void check_body(const BodyPicture& body, int dimension) {
  const std::string who = "body \"" + body.name + "\"";
  require(body.dimension == 2 || body.dimension == 3, who + ": dimension must be 2 or 3");
  require(body.dimension == dimension, who + ": all bodies of a picture have one dimension");
  const bool solid = body.shape == CellShape::tetrahedron || body.shape == CellShape::hexahedron;
  require(solid == (dimension == 3), who + ": the cells do not fit the dimension");
  require(body.points.size() % 3 == 0, who + ": points come three coordinates each");
  const std::size_t n = body.points.size() / 3;
  check_count(body.displacement, n, who, "displacement components", 3);
  check_count(body.values, n, who, "field values");
  check_count(body.stress, n, who, "stress components", 3);
  const std::size_t cells = body.cells.size() / nodes_per_cell(body.shape, 1), facets = body.facets.size() / body.nodes_per_facet;
  require(body.cell_values.empty() || body.cell_values.size() == cells, who, ": ", body.cell_values.size(), " values for ", cells, " cells");
  require(dimension == 2 || body.cell_values.empty() || body.facet_cells.size() == facets, who, ": the cells of ", body.facet_cells.size(), " of ", facets, " facets");
  check_nodes(body.facet_cells, 1, cells, who + ", cells of facets");
  require(finite(body.points), who + ": a coordinate is not finite");
  require(finite(body.displacement), who + ": a displacement is not finite");
  require(dimension == 2 ? body.nodes_per_facet == 2 : body.nodes_per_facet == 3 || body.nodes_per_facet == 4,
          who + ": a facet has 2 nodes in the plane, 3 or 4 in space");
  check_nodes(body.cells, nodes_per_cell(body.shape, 1), n, who + ", cells");
  check_nodes(body.edges, 2, n, who + ", edges");
  check_nodes(body.facets, body.nodes_per_facet, n, who + ", facets");
}

// Least and greatest coordinates of the nodes as drawn.
std::array<Vec3, 2> drawn_box(const ScenePicture& p) {
  Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
  for (const BodyPicture& body : p.bodies)
    for (std::size_t i = 0; i < body.points.size() / 3; ++i) {
      const Vec3 at = body.node(i, p.deformation);
      for (std::size_t c = 0; c < 3; ++c) least[c] = std::min(least[c], at[c]), most[c] = std::max(most[c], at[c]);
    }
  return {least, most};
}

void check_window(const ScenePicture& p) {
  if (!p.window) return;
  const auto [x0, y0, x1, y1] = *p.window;
  const auto refuse = [&](const std::string& why) { throw InputError("window " + box_text(*p.window) + " " + why); };
  if (p.bodies.front().dimension != 2) refuse("needs a scene in the plane; this one is in space");
  if (!(finite(*p.window) && x0 < x1 && y0 < y1)) refuse("is empty; it must be {x0, y0, x1, y1} with x0 < x1 and y0 < y1");
  if (seen(p, box_of(*p.window)).body) return;
  const auto [least, most] = drawn_box(p);
  refuse("shows no body; as drawn, they lie within " + box_text({least[0], least[1], most[0], most[1]}));
}

// Refuses a window or a cut in space that leaves nothing to be seen.
void check_space(const ScenePicture& p) {
  if (!p.cut && !p.region) return;
  const auto [least, most] = drawn_box(p);
  bool stays = !p.cut;
  for (const BodyPicture& body : p.bodies)
    for (std::size_t i = 0; !stays && i < body.points.size() / 3; ++i) stays = p.cut->beyond(body.node(i, p.deformation)) < 0;
  const std::string lie = text("; as drawn, they lie within {", least[0], ", ", least[1], ", ", least[2], ", ", most[0], ", ", most[1], ", ", most[2], "}");
  if (p.cut) require(finite(p.cut->point, p.cut->normal) && p.cut->normal != Vec3{0, 0, 0}, "a cut needs a finite point and a normal that is not zero");
  if (!stays) throw InputError("'cut' leaves nothing of the bodies" + lie + ", and what its 'normal' points to is left out");
  if (!p.region) return;
  const auto& r = *p.region;
  if (!(finite(r) && r[0] < r[3] && r[1] < r[4] && r[2] < r[5])) throw InputError("window is empty; it must be {x0, y0, z0, x1, y1, z1} with x0 < x1, y0 < y1 and z0 < z1");
  for (std::size_t c = 0; c < 3; ++c)
    if (r[c] > most[c] || r[c + 3] < least[c]) throw InputError("window shows no body" + lie);
}

}  // namespace

void check_text(const std::string& key, const std::string& words) {
  constexpr std::size_t most = 1000;
  if (words.size() > most) throw InputError(text(key, " has ", words.size(), " bytes; a text in a figure has at most ", most));
  if (!is_utf8(words)) throw InputError(key + " is not valid UTF-8");
}

void check_sheet(const Sheet& sheet) {
  check_file(sheet.file, {".png", ".pdf", ".svg"}, ".png, .pdf or .svg");
  if (sheet.printed) require(*sheet.printed >= least_printed && *sheet.printed <= greatest_printed, "the width of ", sheet.file, " is ", *sheet.printed, " mm, expected ", least_printed, " to ", greatest_printed);
  const auto possible = [](int side) { return side >= least_side && side <= greatest_side; };
  require(possible(sheet.width) && possible(sheet.height), "the size of ", sheet.file, " is ", sheet.width, " x ", sheet.height, ", expected ", least_side, " to ",
          greatest_side, " pixels each way");
  check_text("'title'", sheet.title);
}

static void check_scene(const ScenePicture& p) {
  check_text("'title'", p.title);
  for (const std::string* unit : {&p.field_unit, &p.pressure_unit}) check_text("'unit'", *unit);
  for (const std::string* unit : {&p.length_unit, &p.load_unit}) check_text("'units'", *unit);
  require(!p.bodies.empty(), "the picture " + p.file + " shows no body");
  require(std::isfinite(p.deformation), "the deformation factor is not finite");
  require(!p.field_range || is_range(*p.field_range), "the range of the field must be {least, greatest}, the greatest beyond the least");
  const int dimension = p.bodies.front().dimension;
  for (const BodyPicture& body : p.bodies) check_body(body, dimension);
  check_window(p);
  check_space(p);
  for (const RigidPicture& rigid : p.obstacles) {
    require(rigid.points.size() % 3 == 0 && finite(rigid.points), "an obstacle needs three finite coordinates a point");
    check_nodes(rigid.triangles, 3, rigid.points.size() / 3, "obstacle, triangles");
  }
  for (const ContactPicture& contact : p.contacts) {
    const std::string who = "contact \"" + contact.name + "\"";
    for (const ContactNode& node : contact.nodes)
      require(finite(node.position, node.displacement, node.normal, node.shear, node.pressure), who + ": a node has a value that is not finite");
    require(contact.nodes_per_facet >= 2 && contact.nodes_per_facet <= 4, who + ": a facet has 2, 3 or 4 nodes");
    check_nodes(contact.facets, contact.nodes_per_facet, contact.nodes.size(), who + ", facets");
    check_count(contact.values, contact.nodes.size(), who, "field values");
  }
  for (const Note& note : p.notes) {
    require(finite(note.position), "a note is at a point that is not finite");
    check_text("'text' of a note", note.text);
  }
  for (const SupportSymbol& s : p.supports) require(finite(s.position, s.displacement, s.normal), "a support has a value that is not finite");
  for (const LoadArrow& l : p.loads) require(finite(l.position, l.displacement, l.vector), "a load has a value that is not finite");
}

void check(const ScenePicture& p) {
  check_sheet(p);
  check_scene(p);
}

void check(const SceneGrid& grid) {
  check_sheet(grid);
  require(!grid.panels.empty() && grid.columns > 0, grid.file + " needs one panel at least, and one column");
  for (const ScenePicture& p : grid.panels) check_scene(p);
}

void check_drawing(const BeamDrawing& b) {
  require(b.length > 0 && std::isfinite(b.length), "the length of a beam is not positive");
  require(b.x.size() >= 2 && b.x.size() == b.deflection.size() && (b.load.empty() || b.load.size() == b.x.size()),
          "a beam needs as many deflections and loads as points, two at least");
  require(finite(b.x, b.deflection, b.load), "a beam has a value that is not finite");
  for (const BeamSupport& s : b.supports)
    require(finite(s.x, s.deflection, s.rotation, s.below.slip, s.arc.slip), "a support of a beam has a value that is not finite");
  for (const BeamLoad& l : b.loads) require(finite(l.x, l.force, l.moment), "a load of a beam has a value that is not finite");
}

void check_drawing(const CurveDrawing& c) {
  require(!c.curves.empty(), "a cell without a curve");
  for (const PageCurve& curve : c.curves)
    require(!curve.x.empty() && curve.x.size() == curve.y.size() && finite(curve.x, curve.y), "a curve needs as many finite y as x, one at least");
  for (const auto& range : {c.x_range, c.y_range})
    require(!range || is_range(*range), "the range of an axis must be {least, greatest}");
}

void check(const PagePicture& p) {
  check_sheet(p);
  require(!p.rows.empty() && p.rows.size() == p.row_weights.size(), "a page needs rows, and a weight of each");
  for (const auto& row : p.rows) {
    require(!row.empty() && row.size() == p.column_weights.size(), "the rows of a page have one cell a column");
    for (const PageCell& cell : row) {
      check_text("'title'", cell.title);
      for (const std::string& label : {cell.x_label, cell.y_label}) check_text("'units'", label);  // the rest of it is ours
      if (const auto* beam = std::get_if<BeamDrawing>(&cell.drawing))
        for (const std::string& unit : {beam->force_unit, beam->moment_unit, beam->load_unit}) check_text("'units'", unit);
      std::visit([](const auto& drawing) { check_drawing(drawing); }, cell.drawing);
    }
  }
  for (const auto& weights : {p.column_weights, p.row_weights})
    for (const double w : weights) require(w > 0 && std::isfinite(w), "the weights of a page are positive");
}

void check_boundary(const PlateEdge& e) {
  require(finite(e.from, e.to), "an edge of a plate has a coordinate that is not finite");
  const bool whole = !e.samples.empty() && e.samples.front().share == 0 && e.samples.back().share == 1;
  require(whole && std::is_sorted(e.samples.begin(), e.samples.end(), [](const EdgeSample& a, const EdgeSample& b) { return a.share < b.share; }),
          "samples along an edge of a plate ascend from 0 to 1");
  for (const EdgeSample& s : e.samples) require(finite(s.deflection, s.reaction), "an edge of a plate has a value that is not finite");
}

void check(const PlatePicture& p) {
  check_sheet(p);
  for (const std::string& unit : {p.field_unit, p.reaction_unit, p.force_unit, p.length_unit}) check_text("'units'", unit);
  require(p.points.size() % 2 == 0, "points of a plate come two coordinates each");
  const std::size_t n = p.points.size() / 2;
  require(!p.triangles.empty(), "the picture " + p.file + " shows no triangle");
  check_nodes(p.triangles, 3, n, "plate, triangles");
  check_nodes(p.bearing, 1, n, "plate, nodes that bear");
  require(p.deflection.size() == n, "plate: ", p.deflection.size(), " deflections for ", n, " nodes");
  check_count(p.values, n, "plate", "field values");
  check_count(p.obstacle, n, "plate", "heights of the obstacle");
  require(finite(p.points, p.deflection, p.deformation), "a plate has a value that is not finite");
  require(!p.field_range || is_range(*p.field_range), "the range of the field must be {least, greatest}, the greatest beyond the least");
  require(!p.view_from || finite(*p.view_from), "the direction towards the eye is not finite");
  for (const PlateEdge& e : p.boundary) check_boundary(e);
  for (const PlateForce& f : p.forces) require(finite(f.x, f.y, f.force), "a force on a plate is not finite");
  for (const PlatePointSupport& s : p.supports) require(finite(s.x, s.y, s.deflection), "a support of a plate has a value that is not finite");
}

void check(const GridFile& g) {
  check_file(g.file, {".vtu", ".pvtu"}, ".vtu or .pvtu");
  const bool list = g.file.ends_with(".pvtu"), plain = g.file.find_first_of("&<>\"", g.file.rfind('/') + 1) == std::string::npos;
  require(g.pieces == 0 || (g.pieces > 0 && list), g.file + ": pieces, one or more, are for a .pvtu");
  require(!list || plain, g.file + ": the name of a .pvtu, which lists names in XML, cannot have & < > or \"");
  require(g.points.size() % 3 == 0, g.file + ": points come three coordinates each");
  require(finite(g.points), g.file + ": a coordinate is not finite");
  const std::size_t n = g.points.size() / 3;
  for (const GridBody& body : g.bodies)
    check_nodes(body.cells, nodes_per_cell(body.shape, body.order), n, "body \"" + body.name + "\", cells");
  for (const GridArray& a : g.arrays)
    require(!a.components.empty() && a.values.size() == a.components.size() * n,
            "array \"", a.name, "\": ", a.values.size(), " values for ", n, " nodes of ", a.components.size(), " components");
}

}  // namespace dotyk::figure

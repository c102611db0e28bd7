// Figures of solved plates.
#include "base/error.hpp"
#include "figure/compose/compose_plate.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/models/bind_plate.hpp"
#include "script/bind/figure_size.hpp"
#include "script/bridge/library.hpp"

namespace dotyk::script {
namespace {

// In the order of PlateView and PlateField.
const std::vector<std::string> kViews = {"surface", "plan"};
const std::vector<std::string> kPlateFields = {"none", "deflection", "mxx", "myy", "mxy", "m1", "m2", "von_mises"};

figure::PlateOptions options(const Call& call) {
  figure::PlateOptions out;
  out.view = static_cast<figure::PlateView>(call.choice("view"));
  out.field = static_cast<figure::PlateField>(call.choice("field"));
  if (call.is("deform", LUA_TNUMBER)) out.deform = call.number("deform");
  out.units = read_units(call);
  return out;
}

int render_plate(Call& call) {
  figure::PlatePicture picture = figure::compose(*call.self<plate::Solution>(), options(call));
  picture.file = call.text("file");
  picture.title = call.has("title") ? call.text("title") : "";
  if (picture.view == figure::PlateView::surface) picture.height = 800;
  read_size(call, picture.width, picture.height);
  if (call.has("edges")) picture.edges = call.boolean("edges") ? figure::MeshEdges::on : figure::MeshEdges::off;
  if (call.has("range")) {
    const auto range = call.vector("range");
    picture.field_range = {range[0], range[1]};
  }
  if (call.has("eye")) {
    const auto eye = call.vector("eye");
    if (picture.view == figure::PlateView::plan) throw InputError("'eye' is for view = \"surface\"; a plan is seen from above");
    if (eye == std::vector<double>{0, 0, 0}) throw InputError("'eye' is zero; it must have a direction");
    picture.view_from = figure::Vec3{eye[0], eye[1], eye[2]};
  }
  figure::draw(picture);
  return call.give(picture.file);
}

}  // namespace

void bind_plate_figure(Library& library) {
  library.extend<plate::Solution>().method(
      {.name = "plate_solution:render",
       .help = "Draws the plate into a PNG file and returns its name. surface: in space, its deflection magnified, over the outline at rest; edges that have "
               "left their support show the gap. plan: from above, with contour lines, reactions per length as areas along the edges and those at corners "
               "and point supports as dots with their numbers. Both show the status of edges, point supports, and hatched what bears on the obstacle.",
       .example = "s:render{ file = \"a.png\", view = \"plan\", field = \"von_mises\", units = { length = \"m\", force = \"kN\" } }",
       .arguments = {key::table(
           {key::file("file", "where to; ends in .png, its folder must exist").written().required(),
            key::choice("view", kViews, "the deflected surface, or the plan").fallback("surface"),
            key::choice("field", kPlateFields, "what the colours show: deflection, moments per length, the principal ones m1 >= m2, von Mises' of them").fallback("deflection"),
            key::either("deform", {key::number("", ""), key::choice("", {"auto"}, "")}, "surface: factor on the deflection; auto: such that it can be seen").fallback("auto"),
            key::boolean("edges", "edges of the triangles").otherwise("on a surface while they can be told apart, none on a plan"),
            key::vector("range", "least and greatest value of the colours").count(2).otherwise("the field's"),
            key::vector("eye", "surface: direction towards the eye").count(3).otherwise("{1, -1.7, 0.8}"),
            key::string("title", "above the figure").otherwise("none"),
            units_key(),
            size_key("{1200, 800}, a plan {1200, 900}")})},
       .run = render_plate});
}

}  // namespace dotyk::script

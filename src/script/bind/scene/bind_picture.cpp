// Pictures of solutions, alone and side by side, and files for ParaView.
#include <cstdio>

#include "figure/canvas/geometry.hpp"
#include "figure/compose/compose.hpp"
#include "script/bind/figure_keys.hpp"

namespace dotyk::script {

namespace {

// What solution:picture makes. `magnify` changes the factor on the displacement; empty if the script gave that factor.
struct Panel {
  figure::ScenePicture picture;
  std::function<void(figure::ScenePicture&, double)> magnify;
};

using figure::FieldChoice;
using figure::PressureStyle;
using figure::ScenePicture;
using figure::SceneOptions;
using scene::Solution;

bool plane(const ScenePicture& picture) { return picture.bodies.front().dimension == 2; }

SceneOptions scene_options(const Call& call, int dimension) {
  SceneOptions options;
  options.obstacle = dimension == 2;
  call.fill(options);
  if (call.is("deform", LUA_TNUMBER)) {
    const double factor = call.number("deform");
    if (factor < 0) throw InputError(text("deform is ", factor, "; it must be zero, positive or \"auto\""));
    options.deform = factor;
  } else if (!call.has("deform") && call.has("window")) {
    options.deform = 1;  // the window is in coordinates of the deformed picture
  }
  if (!(options.explode >= 0 && options.explode <= 100)) throw InputError(text("explode is ", options.explode, "; it must be from 0 to 100"));
  return options;
}

void read_window(const Arguments& call, ScenePicture& picture) {
  if (!call.has("window")) return;
  const std::vector<double> ends = call.vector("window");
  const std::size_t wanted = plane(picture) ? 4 : 6;
  if (ends.size() != wanted)
    throw InputError(text("window has ", ends.size(), " numbers; ", plane(picture) ? "in the plane, and on a map, it is {x0, y0, x1, y1}" : "in space it is {x0, y0, z0, x1, y1, z1}"));
  if (plane(picture)) std::copy(ends.begin(), ends.end(), picture.window.emplace().begin());
  else std::copy(ends.begin(), ends.end(), picture.region.emplace().begin());
}

void read_cut(const Arguments& call, ScenePicture& picture) {
  if (!call.has("cut")) return;
  if (plane(picture)) throw InputError("'cut' is for scenes in space; this picture is 2-D");
  const Arguments given = call.table("cut");
  const std::vector<double> point = given.vector("point"), normal = given.vector("normal");
  figure::Cut& cut = picture.cut.emplace();
  std::copy(point.begin(), point.end(), cut.point.begin());
  std::copy(normal.begin(), normal.end(), cut.normal.begin());
  cut.normal = figure::unit(cut.normal);
  if (cut.normal == figure::Vec3{0, 0, 0}) throw InputError("'normal' of 'cut' is zero; it must have a direction");
}

void read_notes(const Arguments& call, ScenePicture& picture) {
  if (!call.has("notes")) return;
  for (const Arguments& note : call.tables("notes")) {
    const std::vector<double> at = note.vector("at");
    if (at.size() != (plane(picture) ? 2u : 3u)) throw InputError(text("'at' of a note has ", at.size(), " numbers; this picture is ", plane(picture) ? 2 : 3, "-D"));
    figure::Note& out = picture.notes.emplace_back();
    std::copy(at.begin(), at.end(), out.position.begin());
    out.text = note.text("text");
  }
}

// What a call of solution:render or solution:picture shows. `alone`: it has a sheet of its own, on which a map of a contact may stand beside a scene in space.
ScenePicture picture_of(Call& call, bool alone) {
  const auto s = call.self<Solution>();
  const SceneOptions options = scene_options(call, s->scene().dimension());
  const bool map = call.has("map");
  for (const char* key : {"trajectories", "explode", "cut", "deform", "supports", "loads", "obstacle", "inset"})
    if (map && call.has(key)) throw InputError(text("'", key, "' beside 'map', which shows a contact at rest and nothing else"));
  const FieldChoice field = map && !call.has("field") ? FieldChoice::pressure : options.field;
  ScenePicture picture = map ? figure::compose_map(*s, *call.object<scene::Contact>("map"), field) : figure::compose(*s, options);
  figure::SceneUnits units;
  if (call.has("units")) units = call.table("units").filled<figure::SceneUnits>();
  figure::name_units(picture, field, units);
  picture.inset = alone && options.explode == 0;
  call.fill(picture);
  if (call.has("unit")) {
    picture.field_unit = call.text("unit");
    if (units.stress.empty()) picture.pressure_unit = picture.field_unit;
  }
  picture.edges = read_edges(call, map ? figure::MeshEdges::off : figure::MeshEdges::automatic);
  if (call.has("view") && plane(picture)) throw InputError("'view' is for scenes in space; this one is 2-D (try 'window')");
  picture.view_from = read_direction(call, "view");
  if (call.has("cut")) scene::require_whole(s->scene(), "a cut");
  read_window(call, picture), read_cut(call, picture), read_notes(call, picture);
  if (picture.isolines && !plane(picture)) throw InputError("'isolines' are for the plane and for maps; this picture is in space");
  return picture;
}

// The scene, and beside it a part of it, larger; in one row, or in two where the scene is broad.
std::string draw_zoomed(Call& call, ScenePicture whole) {
  if (!plane(whole)) throw InputError("'zoom' is for the plane and for maps; this picture is in space");
  if (call.has("window")) throw InputError("'zoom' and 'window' are given; the scene beside a zoom is shown whole");
  const std::vector<double> ends = call.vector("zoom");
  if (!(ends[0] < ends[2] && ends[1] < ends[3])) throw InputError(text("zoom {", ends[0], ", ", ends[1], ", ", ends[2], ", ", ends[3], "} is empty; it must be {x0, y0, x1, y1} with x0 < x1 and y0 < y1"));
  ScenePicture part = whole;
  std::copy(ends.begin(), ends.end(), part.window.emplace().begin());
  whole.marked.push_back(*part.window);
  figure::SceneGrid grid;
  grid.title = std::exchange(whole.title, "");
  figure::Bounds bounds;
  for (const figure::BodyPicture& body : whole.bodies)
    for (std::size_t i = 0; i < body.points.size(); i += 3) bounds.add(figure::Point{body.points[i], body.points[i + 1]});
  const bool broad = bounds.width() > 1.8 * bounds.height();
  grid.columns = broad ? 1 : 2;
  grid.width = broad ? 1200 : 2100, grid.height = 1000;
  grid.panels = {std::move(whole), std::move(part)};
  grid.panels[1].caption.clear();
  return draw(call, std::move(grid));
}

std::string render_scene(Call& call) {
  ScenePicture picture = picture_of(call, true);
  return call.has("zoom") ? draw_zoomed(call, std::move(picture)) : draw(call, std::move(picture));
}

std::shared_ptr<Panel> make_picture(Call& call) {
  auto panel = std::make_shared<Panel>(Panel{picture_of(call, false), {}});
  call.read("title", panel->picture.title);
  const auto s = call.self<Solution>();
  SceneOptions options = scene_options(call, s->scene().dimension());
  if (!call.has("map") && !options.deform)
    panel->magnify = [s, options](ScenePicture& p, double factor) mutable {
      options.deform = p.deformation = factor;
      p.obstacles = figure::compose(*s, options).obstacles;  // which are magnified as they are composed
    };
  return panel;
}

// Pictures of the same bodies with automatic factors all get the least of these, so that frames of a history can be compared.
void share_factors(const std::vector<std::shared_ptr<Panel>>& panels, std::vector<ScenePicture>& pictures) {
  const auto bodies = [](const ScenePicture& p) {
    std::string names;
    for (const figure::BodyPicture& body : p.bodies) names += body.name + '\n';
    return names;
  };
  std::map<std::string, double> least;
  for (const auto& panel : panels)
    if (panel->magnify) {
      double& factor = least.try_emplace(bodies(panel->picture), panel->picture.deformation).first->second;
      factor = std::min(factor, panel->picture.deformation);
    }
  for (std::size_t i = 0; i < panels.size(); ++i)
    if (panels[i]->magnify && least[bodies(pictures[i])] < pictures[i].deformation) panels[i]->magnify(pictures[i], least[bodies(pictures[i])]);
}

std::string draw_pictures(Call& call) {
  figure::SceneGrid grid;
  const auto panels = call.items<Panel>();
  for (const auto& panel : panels) grid.panels.push_back(panel->picture);
  share_factors(panels, grid.panels);
  const int count = static_cast<int>(grid.panels.size());
  grid.columns = call.has("columns") ? static_cast<int>(std::min<long long>(call.integer("columns"), count)) : std::min(count, 3);
  const int rows = (count + grid.columns - 1) / grid.columns;
  if (grid.columns > 1) grid.width = 2100;
  grid.height = std::min(figure::greatest_side, 60 + rows * grid.width / grid.columns * 4 / 5);
  return draw(call, std::move(grid));
}

// Of solution:render and solution:picture.
std::vector<Key> picture_keys() {
  using Options = SceneOptions;
  using Picture = ScenePicture;
  using Units = figure::SceneUnits;
  return {
      key::choice<FieldChoice>("field", figure::field_names(),
                         "what the colours show. error: each cell's share of solution:error_estimate, the square root. pressure, gap, slip, status: on the "
                         "surfaces of contacts in space, and on a map").into(&Options::field),
      key::object<scene::Contact>("map", "of a contact in space: its surface flat, unrolled, or seen along its mean normal, in place of the scene, with one of "
                                  "the fields pressure (the default), gap, slip, status"),
      key::either("deform", {key::number("", ""), key::choice("", {"auto"}, "")},
                  "factor on the displacement; auto: such that it can be seen").otherwise("\"auto\", with a window 1"),
      key::boolean("contact", "contact status, pressure and obstacles").into(&Options::contact),
      key::boolean("supports", "symbols at supported nodes").into(&Options::supports),
      key::boolean("loads", "arrows for loads").into(&Options::loads),
      key::boolean("obstacle", "rigid obstacles").otherwise("true in the plane, false in space").into(&Options::obstacle),
      key::choice<PressureStyle>("pressure", {{"auto", PressureStyle::automatic}, {"strip", PressureStyle::strip}, {"arrows", PressureStyle::arrows},
                                              {"none", PressureStyle::none}}, "how contact pressure is drawn").into(&Picture::pressure),
      key::boolean("shear", "arrows of the friction on the first part of each contact, where there is any: in the plane "
                            "beside the contact line, in space on the map of the contact").into(&Picture::shear),
      key::boolean("inset", "in space, a small map of the contact that carries most beside the scene").otherwise("true for a picture alone, false with 'explode'").into(&Picture::inset),
      key::boolean("edges", "edges of the cells").otherwise("while they can be told apart; on maps false"),
      key::boolean("isolines", "lines of equal values of the field, at the ticks of its colour bar, in the plane and on maps").into(&Picture::isolines),
      key::boolean("trajectories", "in the plane, lines along the principal stresses: full along the greater, dashed along the lesser").into(&Options::trajectories),
      key::vector("range", "least and greatest value of the colours").count(2).otherwise("the field's").into(&Picture::field_range),
      key::vector("window", "all that is shown, of the deformed picture: in the plane {x0, y0, x1, y1}, to which colours and pressure are "
                            "scaled; in space {x0, y0, z0, x1, y1, z1}").otherwise("all"),
      key::vector("view", "direction towards the eye, in space").count(3),
      key::table("cut", {key::vector("point", "that the plane goes through").count(3).required(), key::vector("normal", "towards what is left out").count(3).required()},
                 "in space: a plane beyond which nothing is drawn; the field is seen on it").otherwise("none"),
      key::number("explode", "in space: bodies stand apart, moved from the middle of the scene by this share of their distance to it").into(&Options::explode),
      key::list("notes", key::table("", {key::vector("at", "the point, of the deformed picture").required(), key::string("text", "what is said of it").required()}, ""),
                "texts at points").otherwise("none"),
      key::string("unit", "unit of the field, and of the pressure where 'units' does not tell that, \"MPa\"").otherwise("none"),
      key::table("units", {key::string("length", "\"mm\"").otherwise("none").into(&Units::length), key::string("stress", "\"MPa\", of pressure and shear too").otherwise("none").into(&Units::stress),
                           key::string("load", "\"N/mm²\"").otherwise("none").into(&Units::load)}, "names of the units, written beside axes and numbers")};
}

}  // namespace

template <> struct Wrapped<Panel> : Called<"picture"> {};

void bind_picture(Library& library) {
  library.type<Panel>("What solution:picture makes: to be drawn beside others by dotyk.pictures.").text([](const Panel& panel) {
    const ScenePicture& p = panel.picture;
    return text("picture of ", p.bodies.size(), p.bodies.size() == 1 ? " body" : " bodies", p.field_label.empty() ? "" : ", " + p.field_label);
  });
  library.function({.name = "dotyk.pictures",
                    .help = "Draws pictures made by solution:picture side by side into a file and returns its name: frames of a history, a scene and the maps of its "
                            "contacts. There is one legend; pictures of one field share the range of its colours, and one bar where all show it; frames of the same bodies share their automatic factor.",
                    .setup = setup::solved_block(),
                    .example = "dotyk.pictures{ file = \"a.png\", columns = 2, s:picture{ title = \"stress\" }, s:picture{ title = \"displacement\", field = \"uy\" } }",
                    .arguments = {key::table(joined(
                        {picture_key(), title_key(), key::integer("columns", "of the pictures, which follow row by row").at_least(1).otherwise("up to 3")},
                        size_keys("{2100, 60 and four fifths of the width of a picture for each row}, one column {1200, …}")))
                                      .with(key::object<Panel>("pictures", "the pictures").count(1, 24))},
                    .run = draw_pictures});
  library.extend<Solution>().method(
      {.name = "solution:render",
       .help = "Draws the deformed bodies coloured by a field, with contact status and pressure, into a file and "
               "returns its name. A deformation factor magnifies the gap and the motion of "
               "rigid obstacles as well, so that what touches is seen to touch.",
       .example = "s:render{ file = \"a.png\", field = \"von_mises\", deform = 10, size = {1200, 800} }",
       .arguments = {key::table(joined(joined({picture_key(), title_key()}, picture_keys()),
                                       joined({key::vector("zoom", "in the plane: {x0, y0, x1, y1}, framed in the picture and drawn larger beside it").count(4).otherwise("none")},
                                              size_keys("{1200, 800}"))))},
       .run = render_scene})
      .method(
      {.name = "solution:picture",
       .help = "The picture that solution:render would draw, to be put beside others by dotyk.pictures.",
       .example = "local p = s:picture{ field = \"uy\", title = \"displacement\" }\nprint(p)",
       .arguments = {key::table(joined({title_key()}, picture_keys()))},
       .run = make_picture})
      .method(
      {.name = "solution:write",
       .help = "Writes the whole solution for ParaView and returns the file's name: all bodies at rest, their cells "
               "numbered by \"body\", with displacement, stress, von_mises and, where there is contact, "
               "contact_pressure, contact_gap and contact_status (0 open, 1 closed, 2 stick, 3 slip, -1 no contact) "
               "at the nodes; of contacts whose nodes do not match at the first part's alone. A .pvtu is a list of files beside it, "
               "a_0.vtu, a_1.vtu, … of a.pvtu, each with a share of the cells, which many readers take side by side. Of bodies with refine on several ranks a .vtu has the cells at the boundary, a .pvtu all: each rank writes its own.",
       .example = "s:write \"a.vtu\"\ns:write(\"parts.pvtu\", { pieces = 2 })",
       .arguments = {key::file("file", "where to; ends in .vtu or .pvtu, its folder must exist").written().required(),
                     key::table("options", {key::integer("pieces", "files of a .pvtu").within(1, 100000).otherwise("one for each million cells")}, "of a .pvtu")
                         .otherwise("none")},
       .run = [](Call& call) {
         const auto s = call.self<Solution>();
         if (s->model().problem.hides() && call.text("file").ends_with(".pvtu")) {
           if (call.has("options")) throw InputError("of bodies with refine on several ranks each rank writes a piece; leave the number of pieces away");
           figure::write_pieces(*s, call.text("file"));
           return call.text("file");
         }
         figure::GridFile grid = figure::compose_grid(*s, call.text("file"));
         if (call.has("options") && call.table("options").has("pieces")) grid.pieces = static_cast<int>(call.table("options").number("pieces"));
         figure::write(grid);
         if (s->model().problem.hides())
           std::fprintf(stderr, "dotyk: %s has only the cells at the boundary; a .pvtu has all cells\n", call.text("file").c_str());
         return call.text("file");
       }});
}

}  // namespace dotyk::script

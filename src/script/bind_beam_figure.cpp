// Figures of beams and of the laws of their supports.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "figure/compose_beam.hpp"
#include "script/bind.hpp"
#include "script/bind_beam.hpp"
#include "script/figure_size.hpp"
#include "script/library.hpp"

namespace dotyk::script {
namespace {

using figure::LawSide;
using problem::SupportLaw;

const std::vector<std::string> kPanels = {"deflection", "moment", "shear"};
const std::vector<std::string> kSides = {"deflection", "rotation"};

std::vector<Key> page_keys(std::vector<Key> keys, const char* size) {
  keys.insert(keys.begin(), key::string("file", "where to; ends in .png, its folder must exist").required());
  keys.push_back(key::string("title", "above the figure").otherwise("none"));
  keys.push_back(key::table("units", {key::string("length", "\"m\"").otherwise("none"), key::string("force", "\"kN\"").otherwise("none")}, "names of the units, written beside the axes"));
  keys.push_back(size_key(size));
  return keys;
}

figure::Units units(const Arguments& call) {
  if (!call.has("units")) return {};
  const Arguments given = call.table("units");
  return {given.has("length") ? given.text("length") : "", given.has("force") ? given.text("force") : ""};
}

int draw(Call& call, figure::PagePicture picture) {
  picture.file = call.text("file");
  picture.title = call.has("title") ? call.text("title") : "";
  read_size(call, picture.width, picture.height);
  figure::draw(picture);
  return call.give(picture.file);
}

int render(Call& call) {
  const beam::Solution& s = call.self<BeamResult>()->solution();
  std::vector<figure::BeamPanel> panels = {figure::BeamPanel::deflection, figure::BeamPanel::moment, figure::BeamPanel::shear};
  if (call.has("panels")) {
    panels.clear();
    for (const std::string& name : call.texts("panels"))
      panels.push_back(static_cast<figure::BeamPanel>(std::find(kPanels.begin(), kPanels.end(), name) - kPanels.begin()));
  }
  figure::PagePicture picture = figure::compose(s, panels, units(call));
  double weight = 0;
  for (const double w : picture.row_weights) weight += w;
  picture.height = 60 + static_cast<int>(std::lround(250 * weight));
  return draw(call, std::move(picture));
}

LawSide side(const Arguments& from) { return static_cast<LawSide>(from.choice("of")); }

int render_law(Call& call) {
  const beam::Solution& s = call.self<BeamResult>()->solution();
  return draw(call, figure::compose(s, find_support(s.beam(), call, "support"), side(call), units(call)));
}

int render_support_law(Call& call) { return draw(call, figure::compose(*call.self<SupportLaw>(), side(call), units(call))); }

int gallery(Call& call) {
  std::vector<figure::GalleryRow> rows;
  std::vector<std::shared_ptr<BeamResult>> kept;
  for (const Arguments& row : call.tables("rows")) {
    kept.push_back(row.object<BeamResult>("solution"));
    const beam::Solution& s = kept.back()->solution();
    rows.push_back({row.has("title") ? row.text("title") : "", &s, find_support(s.beam(), row, "support"), side(row)});
  }
  return draw(call, figure::compose(rows));
}

Key of_key() { return key::choice("of", kSides, "the law of which").fallback("deflection"); }

}  // namespace

void bind_beam_figure(Library& library) {
  library.extend<BeamResult>()
      .method({.name = "beam_solution:render",
               .help = "Draws the deflection line (exaggerated) with supports as symbols and loads as arrows, the bending moment and the shear force "
                       "over one x axis into a PNG file, and returns its name. Supports are coloured by what they do.",
               .example = "s:render{ file = \"images/a.png\", panels = { \"deflection\", \"moment\" }, units = { length = \"m\", force = \"kN\" } }",
               .arguments = {key::table(page_keys({key::list("panels", key::choice("", kPanels, ""), "what is drawn, from above").count(1, 3)
                                                      .otherwise("all three")}, "{1000, 250 for each diagram and 400 for the deflection}"))},
               .run = render})
      .method({.name = "beam_solution:render_law",
               .help = "Draws the law of a support with the working point on it, its reaction against its displacement, and the superpotential beside it, "
                       "into a PNG file, and returns its name. Displacements that the law forbids are grey.",
               .example = "s:render_law{ file = \"images/a.png\", support = \"right\", of = \"deflection\" }",
               .arguments = {key::table(page_keys({support_key("support").required(), of_key()}, "{1100, 480}"))},
               .run = render_law});
  library.extend<SupportLaw>().method(
      {.name = "law:render",
       .help = "Draws the law, its reaction against the displacement, and its superpotential into a PNG file, and returns its name. "
               "One-sided laws of a rotation resist slopes above zero.",
       .example = "dotyk.law.capped_elastic(100, 2):render{ file = \"images/a.png\" }",
       .arguments = {key::table(page_keys({of_key()}, "{1100, 480}"))},
       .run = render_support_law});
  library.function({.name = "dotyk.support_gallery",
                    .help = "Draws rows of solved beams, the law of one support each with the working point, and its superpotential, into a PNG file, "
                            "and returns its name.",
                    .example = "dotyk.support_gallery{ file = \"images/a.png\", rows = { { solution = s, support = \"right\", title = \"A stop\" } } }",
                    .arguments = {key::table({key::string("file", "where to; ends in .png, its folder must exist").required(),
                                              key::list("rows", key::table("", {key::object<BeamResult>("solution", "a solved beam").required(), support_key("support").required(), of_key(),
                                                                                key::string("title", "above the row").otherwise("none")}, ""),
                                                        "from above").count(1, 12).required(),
                                              key::string("title", "above all").otherwise("none"),
                                              size_key("{1600, 380 a row}")})},
                    .run = gallery});
}

}  // namespace dotyk::script

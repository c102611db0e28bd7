// Figures of beams and of the laws of their supports.
#include "script/bind/models/models.hpp"
#include "script/bind/figure_keys.hpp"

namespace dotyk::script {
namespace {

using figure::BeamPanel;
using figure::LawSide;
using problem::LawChoice;

template <class Enum>
using Names = std::vector<std::pair<const char*, Enum>>;

// A plain beam has the first ones.
const Names<BeamPanel> kPanels = {{"deflection", BeamPanel::deflection}, {"moment", BeamPanel::moment}, {"shear", BeamPanel::shear},
                                  {"normal", BeamPanel::normal}, {"temperature", BeamPanel::temperature}, {"gradient", BeamPanel::gradient},
                                  {"displacement", BeamPanel::displacement}};
const Names<LawSide> kSides = {{"deflection", LawSide::deflection}, {"rotation", LawSide::rotation}, {"displacement", LawSide::displacement}};
template <class Enum>
Names<Enum> first(const Names<Enum>& names, int count) { return {names.begin(), names.begin() + count}; }

std::vector<Key> page_keys(const std::vector<Key>& keys, const char* size, bool heat = false) {
  return joined(joined(joined({picture_key()}, keys), {title_key(), units_key(heat)}), size_keys(size));
}

std::vector<BeamPanel> panels(const Arguments& call, std::vector<BeamPanel> otherwise) {
  return call.has("panels") ? call.choices<BeamPanel>("panels") : otherwise;
}

std::string render_beam(Call& call) {
  const auto chosen = panels(call, {BeamPanel::deflection, BeamPanel::moment, BeamPanel::shear});
  return draw(call, figure::compose(figure::view(call.self<BeamResult>()->solution()), chosen, read_units(call)));
}

LawSide side(const Arguments& from) { return from.choice<LawSide>("of"); }

std::string render_law(Call& call) {
  const beam::Solution& s = call.self<BeamResult>()->solution();
  return draw(call, figure::compose(figure::view(s), find_support(s.beam(), call, "support"), side(call), read_units(call)));
}

std::string render_support_law(Call& call) {
  const LawChoice& law = *call.self<LawChoice>();
  if (std::any_of(law.numbers.begin(), law.numbers.end(), [](double n) { return std::isnan(n); })) throw InputError("a number of this law is a function of the place; its graph is that of numbers");
  return draw(call, figure::compose(law, side(call), read_units(call)));
}

// As it is now, with the load along it.
figure::BeamView view_now(const CalledLoads& called) {
  const thermoelastic::Source& q = called.loads.transverse;
  std::function<double(double)> load;
  if (q.of) load = [&q, t = called.beam->stepping->time()](double x) { return q.of(x, t); };
  else if (q.constant != 0) load = [&q](double) { return q.constant; };
  return figure::view(*called.beam->stepping, std::move(load));
}

std::string render_thermoelastic(Call& call) {
  const CalledLoads called(call, "draw it");
  const auto chosen = panels(call, {BeamPanel::deflection, BeamPanel::moment, BeamPanel::temperature, BeamPanel::gradient});
  return draw(call, figure::compose(view_now(called), chosen, read_units(call)));
}

std::string render_thermoelastic_law(Call& call) {
  const CalledLoads called(call, "draw it");
  const thermoelastic::Data& data = called.beam->stepping->data();
  const int support = find_support(thermoelastic::plain(data), call, "support");
  const bool end = support == 0 || support + 1 == static_cast<int>(data.supports.size());
  if (side(call) == LawSide::displacement && !end) throw InputError("supports within the beam have no law about the displacement along it; \"left\" and \"right\" have");
  return draw(call, figure::compose(view_now(called), support, side(call), read_units(call)));
}

std::string gallery(Call& call) {
  std::vector<figure::GalleryRow> rows;
  std::vector<std::shared_ptr<BeamResult>> kept;
  for (const Arguments& row : call.tables("rows")) {
    kept.push_back(row.object<BeamResult>("solution"));
    const beam::Solution& s = kept.back()->solution();
    rows.push_back({row.has("title") ? row.text("title") : "", figure::view(s), find_support(s.beam(), row, "support"), side(row)});
  }
  return draw(call, figure::compose(rows));
}

Key of_key(int sides = 2) { return key::choice("of", first(kSides, sides), "the law of which").fallback("deflection"); }

Key panels_key(int panels, const char* otherwise) {
  return key::list("panels", key::choice("", first(kPanels, panels), ""), "what is drawn, from above").count(1, static_cast<std::size_t>(panels)).otherwise(otherwise);
}

void add_thermoelastic(Library& library) {
  library.extend<ThermoelasticBeam>()
      .method({.name = "thermoelastic_beam:render",
               .help = "Draws the beam as it is now: the deflection line (exaggerated) with supports as symbols and loads as arrows, moment, shear and normal "
                       "force, temperature on the axis and its slope over the height, displacement along the axis, over one x axis into a file, and "
                       "returns its name. Supports are coloured by what they do about deflection and rotation.",
               .example = "b:run(60):render{ file = \"a.png\", panels = { \"deflection\", \"temperature\" }, units = { length = \"m\", temperature = \"K\" } }",
               .arguments = {key::table(page_keys({panels_key(7, "deflection, moment, temperature and gradient")},
                                                  "{1000, 60 and 250 for each diagram and 400 for the deflection}", true))},
               .run = render_thermoelastic})
      .method({.name = "thermoelastic_beam:render_law",
               .help = "Draws the law of a support with where it is on it now, its reaction against its displacement, and the superpotential beside it, "
                       "into a file, and returns its name. Displacements that the law forbids are grey.",
               .example = "b:run(60):render_law{ file = \"a.png\", support = \"left\", of = \"displacement\" }",
               .arguments = {key::table(page_keys({support_key("support").required(), of_key(3)}, "{1100, 480}"))},
               .run = render_thermoelastic_law});
}

}  // namespace

void bind_beam_figure(Library& library) {
  library.extend<BeamResult>()
      .method({.name = "beam_solution:render",
               .help = "Draws the deflection line (exaggerated) with supports as symbols and loads as arrows, the bending moment and the shear force "
                       "over one x axis into a file, and returns its name. Supports are coloured by what they do.",
               .example = "s:render{ file = \"a.png\", panels = { \"deflection\", \"moment\" }, units = { length = \"m\", force = \"kN\" } }",
               .arguments = {key::table(page_keys({panels_key(3, "all three")}, "{1000, 60 and 250 for each diagram and 400 for the deflection}"))},
               .run = render_beam})
      .method({.name = "beam_solution:render_law",
               .help = "Draws the law of a support with the working point on it, its reaction against its displacement, and the superpotential beside it, "
                       "into a file, and returns its name. Displacements that the law forbids are grey.",
               .example = "s:render_law{ file = \"a.png\", support = \"right\", of = \"deflection\" }",
               .arguments = {key::table(page_keys({support_key("support").required(), of_key()}, "{1100, 480}"))},
               .run = render_law});
  library.extend<LawChoice>().method(
      {.name = "law:render",
       .help = "Draws the law, its reaction against the displacement, and its superpotential into a file, and returns its name. "
               "One-sided laws of a rotation resist slopes above zero.",
       .example = "dotyk.law.capped_elastic(100, 2):render{ file = \"a.png\" }",
       .arguments = {key::table(page_keys({of_key()}, "{1100, 480}"))},
       .run = render_support_law});
  library.function({.name = "dotyk.support_gallery",
                    .help = "Draws rows of solved beams, the law of one support each with the working point, and its superpotential, into a file, "
                            "and returns its name.",
                    .setup = setup::solved_beam(),
                    .example = "dotyk.support_gallery{ file = \"a.png\", rows = { { solution = s, support = \"right\", title = \"A stop\" } } }",
                    .arguments = {key::table(joined({picture_key(),
                                              key::list("rows", key::table("", {key::object<BeamResult>("solution", "a solved beam").required(), support_key("support").required(), of_key(),
                                                                                title_key("above the row")}, ""),
                                                        "from above").count(1, 12).required(),
                                              title_key("above all")},
                                              size_keys("{1600, 60 and 380 a row, at most 1795}")))},
                    .run = gallery});
  add_thermoelastic(library);
}

}  // namespace dotyk::script

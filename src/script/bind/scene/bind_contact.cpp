#include "scene/study/inf_sup.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {
namespace {

using scene::Contact;
using scene::MultiplierPart;
using scene::InfSupSettings;

Record inf_sup(Call& call) {
  const auto settings = call.filled<InfSupSettings>();
  Watch watch(call.state(), "inf-sup constants");
  const scene::InfSup s = scene::inf_sup(*call.self<Contact>(), settings, watch);
  return {"inf-sup", {{"constant", s.constant}, {"above_kernel", s.above_kernel}, {"kernel", s.kernel}, {"multipliers", s.multipliers},
                      {"h", s.h}, {"H", s.H}, {"cone", s.cone}}};
}

}  // namespace

void bind_contact(Library& library) {
  library.type<Contact>("A contact or a glue of a scene.")
      .setup(setup::pressed_block())
      .field("name", "what messages call it", [](const Contact& c) { return c.name; })
      .field("rows", "number of contact conditions", [](const Contact& c) { return c.rows.size(); })
      .method({.name = "contact:inf_sup",
               .help = "The stability constant of the contact's multipliers against the displacements of its bodies "
                       "(inf-sup, Babuška–Brezzi): constant, the least b(mu, v)/(|v|_1 |mu|_-1/2) over multipliers, greatest over "
                       "displacements; 0 where multipliers form a kernel that no displacement notices (kernel, its dimension; "
                       "above_kernel, the least constant but 0); multipliers, h, H. About 1 is as good as it "
                       "gets. Supports, meshes and multipliers enter, the material does not.",
               .example = "print(contact:inf_sup{ part = \"normal\" }.constant)",
               .arguments = {key::table({key::choice<MultiplierPart>("part", {{"tangential", MultiplierPart::tangential}, {"normal", MultiplierPart::normal},
                                                                                {"both", MultiplierPart::both}}, "which multipliers").into(&InfSupSettings::part),
                                         key::choice<bool>("fixed_nodes", {{"shared", true}, {"kept", false}},
                                                     "multipliers of nodes held on both sides, and those of friction at corners of the part: shared out among their neighbours, as in a solve, or kept").into(&InfSupSettings::share_fixed),
                                         key::choice<bool>("norm", {{"shear", false}, {"multiplier", true}}, "of friction: of the shear g mu, or of mu itself, as TR965 (3.16) has it").into(&InfSupSettings::own_norm),
                                         key::boolean("cone", "also .cone: the least constant found over pressures that are not negative").into(&InfSupSettings::cone)})},
               .run = inf_sup})
      .text([](const Contact& c) { return c.name; });
}

}  // namespace dotyk::script

// Domain decomposition: dotyk.solver.feti.
#include "script/bind/bind.hpp"
#include "script/bind/methods/method_keys.hpp"
#include "solver/feti/feti.hpp"

namespace dotyk::script {
namespace {

constexpr int kMost = 1'000'000;

/// A member of the augmented Lagrangian's settings.
template <class Value>
auto outer(Value solver::Smalbe::*member) {
  return [member](solver::Feti& feti) -> Value& { return feti.outer.*member; };
}

void read_subdomains(const Call& call, problem::Decomposition& cut) {
  if (call.is("subdomains", LUA_TNUMBER)) {
    cut.count = static_cast<int>(call.integer("subdomains"));
  } else if (call.has("subdomains")) {
    const auto boxes = call.integers("subdomains");
    if (boxes.size() != 2 && boxes.size() != 3)
      throw InputError(text("subdomains has ", boxes.size(), boxes.size() == 1 ? " entry" : " entries", "; give a number, or two (in space three) numbers of boxes"));
    for (std::size_t k = 0; k < boxes.size(); ++k) cut.boxes[k] = static_cast<int>(boxes[k]);
  }
}

std::string show(const Call& call, const problem::Decomposition& cut) {
  if (!call.has("subdomains")) return "a subdomain a body";
  if (cut.count > 0) return text(cut.count, " subdomains");
  return text(cut.boxes[0], " × ", cut.boxes[1], " × ", cut.boxes[2], " boxes a body");
}

}  // namespace

void bind_feti(Library& library) {
  using solver::Feti, solver::Smalbe;
  using Preconditioner = Feti::Preconditioner;
  using Stop = Feti::Stop;
  using Update = Smalbe::Update;
  using Expansion = solver::MprgpSettings::Expansion;
  add_method<Feti>(
      library,
      {.name = "dotyk.solver.feti",
       .help = "Domain decomposition for many bodies and for bodies beyond a direct method: every body is cut into "
               "subdomains, glued by multipliers, and the dual problem is solved by augmented Lagrangians with projectors to "
               "the natural coarse space of the subdomains' rigid motions. Frictionless contact, given friction, and "
               "Coulomb's by an outer loop. tol: on |projected gradient| / |P d| and on |G lambda - e| / |f|, rows "
               "scaled by the stiffness of what they join, and on what a subdomain's forces leave unbalanced. An iteration is an outer step; s.history[k].inner counts the steps of the inner method so far, "
               "s.feti tells what the decomposition was like.",
       .example = "local s = dotyk.solver.feti{ subdomains = 64, tol = 1e-8 }:solve(scene)\n"
                  "local t = dotyk.solver.feti{ subdomains = {4, 4, 4}, preconditioner = \"lumped\" }:solve(scene)"},
      {key::either("subdomains",
                   {key::integer("", "how many in all, shared out by cells and cut by METIS").within(1, kMost),
                    key::list("", key::integer("", "").within(1, 1000), "boxes along each axis of every body's bounding box; a third number counts in space only")},
                   "into what bodies are cut: a number in all, or boxes along the axes").otherwise("a subdomain a body"),
       key::choice<bool>("supports", {{"rows", true}, {"stiffness", false}}, "supports and springs as rows of the dual problem (total FETI: subdomains "
                   "of equal shape share a factor, and all have rigid motions for the coarse space), or in the subdomains' stiffness")
           .into<Feti>([](Feti& feti) -> bool& { return feti.decomposition.support_rows; }),
       key::choice<Preconditioner>("preconditioner", {{"none", Preconditioner::none}, {"lumped", Preconditioner::lumped}, {"dirichlet", Preconditioner::dirichlet}},
                                    "of the inner conjugate gradients; lumped is the paper's with coarse = \"whole\" alone").into(&Feti::preconditioner),
       key::choice<bool>("coarse", {{"face", true}, {"whole", false}}, "the coarse space in conjugate gradients: that of the multipliers free to "
                   "change, or only in the projectors (as the paper)").into(&Feti::face_coarse),
       key::choice<Update>("update", {{"precision", Update::precision}, {"penalty", Update::penalty}, {"both", Update::both}},
                            "of the augmented Lagrangian: of the inner precision M with rho "
                            "fixed (SMALBE-M), of rho with M fixed (the paper's algorithm 4.1), or whichever holds it up").into<Feti>(outer(&Smalbe::update)),
       key::positive("M", "an inner minimisation ends at |projected gradient| <= M |G lambda - e|; in units of |PFP|").into<Feti>(outer(&Smalbe::M)),
       key::positive("rho", "penalty of G lambda = e, at first; in units of |PFP|").below(1e10).into<Feti>(outer(&Smalbe::rho)),
       key::choice<Stop>("stop", {{"Pd", Stop::Pd}, {"d", Stop::d}}, "what tol compares the projected gradient with; d, the paper's, depends on the generalised "
                          "inverse, and then nothing is asked of what a subdomain's forces leave unbalanced but |G lambda - e|").into(&Feti::stop),
       key::positive("eta", "first bound of algorithm 4.1 on |G lambda - e|, beyond which rho grows, in units of |P d|/|PFP|; for other "
                      "updates on the projected gradient, in units of |P d|").into<Feti>(outer(&Smalbe::eta)),
       key::choice<Expansion>("expansion", {{"fixed_step", Expansion::fixed_step}, {"projected_cg", Expansion::projected_cg_step}},
                               "how the inner method lets multipliers reach their bounds: fixed projected steps (MPRGP), or projected "
                               "conjugate gradient steps (proportioning with projections)").into(&Feti::expansion),
       key::integer("max_inner", "give up after so many inner steps").at_least(1).into(&Feti::max_inner),
       key::boolean("spectrum", "estimate the condition of PFP on im P, in s.feti.condition").into(&Feti::spectrum)},
      1000, [](Feti& feti, Call& call) {
        read_subdomains(call, feti.decomposition);
        feti.max_inner = std::min(feti.max_inner, 100'000'000);
        return text(show(call, feti.decomposition), ", preconditioner = ", call.text("preconditioner"), ", M = ", feti.outer.M, ", rho = ", feti.outer.rho);
      });
}

}  // namespace dotyk::script

#include "script/bind/bind.hpp"

namespace dotyk::script {
namespace {

algebra::DenseMatrix matrix_of(const std::vector<std::vector<double>>& rows) {
  algebra::DenseMatrix m(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != rows.size())
      throw InputError(text("row ", i + 1, " of stiffness has ", rows[i].size(), " numbers; the matrix must be ",
                            "3x3 (plane) or 6x6 (space)"));
    for (std::size_t j = 0; j < rows.size(); ++j) m(i, j) = rows[i][j];
  }
  return m;
}

Given<Material> make_material(Call& call) {
  auto material = std::make_shared<Material>(call.filled<Material>());
  if (call.has("stiffness")) {
    if (call.has("E") || call.has("nu"))
      throw InputError("give either E and nu, or stiffness, not both");
    material->stiffness = elasticity::from_voigt(matrix_of(call.matrix("stiffness")));
    return call.give_keeping(material, {});
  }
  if (!call.has("E")) throw InputError("E is missing: give E and nu, or a stiffness matrix");
  material->E_varies = call.is("E", LUA_TFUNCTION);
  material->nu_varies = call.is("nu", LUA_TFUNCTION);
  if (!material->E_varies) material->E = call.field("E")({})[0];
  if (!material->nu_varies) material->nu = call.has("nu") ? call.field("nu")({})[0] : 0.3;
  elasticity::check_isotropic(material->E_varies ? 1.0 : material->E, material->nu_varies ? 0.0 : material->nu,
                              material->plane == elasticity::Plane::stress);
  return call.give_keeping(material, {"E", "nu"});
}

std::string material_text(const Material& m) {
  if (m.stiffness) return text("material: general stiffness, ", m.stiffness->dimension, "-D");
  return "material: E = " + (m.E_varies ? "function" : text(m.E)) + ", nu = " +
         (m.nu_varies ? "function" : text(m.nu)) + ", plane " +
         (m.plane == elasticity::Plane::strain ? "strain" : "stress");
}

}  // namespace

void bind_material(Library& library) {
  using elasticity::Plane;
  library.function(
      {.name = "dotyk.material",
       .help = "A linearly elastic material: isotropic with E and nu, or general with a stiffness matrix in "
               "Voigt's order (xx yy xy; xx yy zz yz xz xy; engineering shear). E and nu may be functions "
               "of the coordinates; they are evaluated at the cells' centres when a body is made.",
       .example = "local steel = dotyk.material{ E = 210e3, nu = 0.3 }",
       .arguments = {key::table(
           {key::field("E", "Young's modulus").unit("stress"),
            key::field("nu", "Poisson's ratio, above -1 and below 0.5").otherwise("0.3"),
            key::choice<Plane>("plane", {{"strain", Plane::strain}, {"stress", Plane::stress}},
                               "what a plane body assumes of the third direction").into(&Material::plane),
            key::matrix("stiffness", "3x3 in the plane, 6x6 in space, instead of E and nu").unit("stress"),
            key::number("density", "mass per volume, for scripts to use").unit("mass/volume").above(0).into(&Material::density)})},
       .run = make_material});
  library.type<Material>("An elastic material.")
      .field("E", "Young's modulus; nil where it is a function or the material is general",
             [](const Material& m) { return m.E_varies || m.stiffness ? std::nullopt : std::optional(m.E); }, "stress")
      .field("nu", "Poisson's ratio; nil where it is a function or the material is general",
             [](const Material& m) { return m.nu_varies || m.stiffness ? std::nullopt : std::optional(m.nu); })
      .field("density", "mass per volume, 0 if none was given",
             [](const Material& m) { return m.density.value_or(0); }, "mass/volume")
      .text(material_text);
}

}  // namespace dotyk::script

#include "plate/plate.hpp"

#include <cmath>
#include <map>

#include "base/error.hpp"

namespace dotyk::plate {

const char* element_name(Element element) { return element == Element::morley ? "Morley" : "HCT"; }

namespace {

void require_facets_once(const Plate& plate) {
  std::map<mesh::Facet, const EdgeSupport*> taken;
  for (const EdgeSupport& edge : plate.edges)
    for (const mesh::Facet f : edge.facets) {
      const auto [place, fresh] = taken.emplace(f, &edge);
      if (fresh) continue;
      const mesh::Point at = plate.mesh->facet_centre(f);
      throw InputError(text("the edge at ", point_text(at.data(), 2), " belongs to '", place->second->part, "' and to '", edge.part,
                            "'; laws may be given for one of them"));
    }
}

}  // namespace

void require_valid(const Plate& plate) {
  if (!plate.mesh) throw InputError("it has no mesh");
  if (plate.mesh->element != mesh::Element::triangle_p1)
    throw InputError(text("its mesh is of ", plate.mesh->topology().shapes, " (", plate.mesh->topology().name, "); plates need triangles (element = \"P1\") in the plane"));
  if (!plate.D_of && (!(plate.D > 0) || !std::isfinite(plate.D))) throw InputError(text("its bending stiffness D is ", plate.D, "; it must be positive"));
  if (!(plate.nu > -1 && plate.nu < 1)) throw InputError(text("nu is ", plate.nu, "; it must be between -1 and 1"));
  if (plate.element == Element::morley && std::abs(plate.nu) > kMostMorleyNu)
    throw InputError(text("nu is ", plate.nu, "; with Morley's element it must be between ", -kMostMorleyNu, " and ", kMostMorleyNu,
                          ": nearer to -1 and 1 its error grows beyond all bounds; take element = \"hct\""));
  if (!plate.f_of && !std::isfinite(plate.f)) throw InputError(text("its load is ", plate.f));
  for (const PointLoad& load : plate.point_loads)
    if (!std::isfinite(load.force)) throw InputError(text("the load at (", load.x, ", ", load.y, ") is ", load.force));
  for (const LineLoad& load : plate.line_loads) {
    if (!std::isfinite(load.force)) throw InputError(text("the load along a line is ", load.force));
    if (load.from[0] == load.to[0] && load.from[1] == load.to[1])
      throw InputError(text("the line of a load begins and ends at (", load.from[0], ", ", load.from[1], ")"));
  }
  for (const PointSupport& support : plate.supports) {
    require_valid(support.deflection);
    if (support.deflection->breaks) throw InputError("supports of plates do not break; capped_elastic yields instead");
  }
  require_facets_once(plate);
}

}  // namespace dotyk::plate

#include "script/visits.hpp"

#include <stdexcept>

#include "figure/compose/compose_pieces.hpp"
#include "scene/result/inner_cells.hpp"

namespace dotyk::script {

Lists visit(multigrid::VisitFor what, const multigrid::VisitedCells& at, const Lists& said) {
  switch (what) {
    case multigrid::VisitFor::estimate: return scene::estimate_cells(at, said);
    case multigrid::VisitFor::point: return scene::values_at_point(at, said);
    case multigrid::VisitFor::write: return figure::write_cells(at, said);
  }
  throw std::logic_error("a visit for nothing known");
}

}  // namespace dotyk::script

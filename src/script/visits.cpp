#include "script/visits.hpp"

#include <stdexcept>

#include "figure/compose/compose_pieces.hpp"
#include "scene/result/inner_cells.hpp"

namespace dotyk::script {

multigrid::VisitCells visit(multigrid::VisitFor what) {
  switch (what) {
    case multigrid::VisitFor::estimate: return scene::estimate_cells;
    case multigrid::VisitFor::point: return scene::values_at_point;
    case multigrid::VisitFor::write: return figure::write_cells;
  }
  throw std::logic_error("a visit for nothing known");
}

}  // namespace dotyk::script

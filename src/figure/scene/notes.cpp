// Texts at points of a scene, and boxes that frame parts of it.
#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

void draw_notes(Stage& stage, vtkRenderer*) {
  const double em = stage.em, size = 0.9 * em;
  for (const auto& [x0, y0, x1, y1] : stage.picture.marked) {
    const Point a = stage.view.flat({x0, y0, 0}), b = stage.view.flat({x1, y1, 0});
    stage.over.outline({a.x, a.y, b.x, b.y}, std::max(1.5, em / 12), axes_ink);
  }
  std::vector<Box> taken;
  for (const Note& note : stage.picture.notes) {
    const Point at = stage.view.flat(note.position), extent = text_extent(note.text, size);
    if (!stage.shows(at)) continue;
    stage.over.disc(at, 0.2 * em, {255, 255, 255});
    stage.over.disc(at, 0.14 * em, axes_ink);
    // Of the places around the point the first that is in the room and clear of other notes; farther off where none near it is.
    std::optional<Box> place;
    for (const double far : {0.9, 2.0, 3.2})
      for (const Point d : {Point{0.8, 0.6}, Point{-0.8, 0.6}, Point{0.8, -0.6}, Point{-0.8, -0.6}, Point{0, 1}, Point{0, -1}}) {
        const Point end = at + far * em * d;
        const Box box = Box::about({end.x + (d.x > 0 ? 0.5 : d.x < 0 ? -0.5 : 0) * extent.x, end.y + (d.y > 0 ? 0.5 : -0.5) * extent.y}, extent).grown(0.1 * em);
        if (place || !stage.room.holds({box.left, box.bottom}) || !stage.room.holds({box.right, box.top}) || std::ranges::any_of(taken, [&](const Box& other) { return box.overlaps(other); })) continue;
        place = box;
        stage.over.line(at, end, std::max(1.0, em / 20), axes_ink);
      }
    if (!place) continue;
    taken.push_back(*place);
    stage.over.text(place->centre(), note.text, {.size = size, .across = Align::middle, .up = Align::middle, .colour = axes_ink, .halo = true});
  }
}

}  // namespace

Layer note_layer() { return {7, draw_notes}; }

}  // namespace dotyk::figure

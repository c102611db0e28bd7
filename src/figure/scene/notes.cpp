// Texts at points of a scene, and boxes that frame parts of it.
#include "base/error.hpp"
#include "figure/canvas/axes.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

// The place of a note's words around its point that is in the room and clear of other notes, and the end of the line to it; the nearest one.
std::optional<std::pair<Box, Point>> place_of(const Stage& stage, Point at, Point extent, const std::vector<Box>& taken) {
  const Box& room = stage.room;
  for (double far = 0.9 * stage.em; far < room.width() + room.height(); far += stage.em)
    for (const Point d : {Point{0.8, 0.6}, Point{-0.8, 0.6}, Point{0.8, -0.6}, Point{-0.8, -0.6}, Point{0, 1}, Point{0, -1}}) {
      const Point end = at + far * d;
      const Box box = Box::about({end.x + (d.x > 0 ? 0.5 : d.x < 0 ? -0.5 : 0) * extent.x, end.y + (d.y > 0 ? 0.5 : -0.5) * extent.y}, extent).grown(0.1 * stage.em);
      if (room.holds({box.left, box.bottom}) && room.holds({box.right, box.top}) && std::ranges::none_of(taken, [&](const Box& other) { return box.overlaps(other); }))
        return std::pair{box, end};
    }
  return std::nullopt;
}

void draw_note(Stage& stage, const Note& note, std::vector<Box>& taken) {
  const double em = stage.em;
  const Point at = stage.view.flat(note.position);
  const FittedText words = fitted(note.text, 0.9 * em, 0.6 * stage.room.width());
  const auto place = place_of(stage, at, extent_of(words), taken);
  if (!place) throw InputError("no room for the note \"" + note.text + "\" on the picture; make it larger");
  const auto& [box, end] = *place;
  taken.push_back(box);
  stage.over.line(at, end, std::max(1.0, em / 20), axes_ink);
  stage.over.disc(at, 0.2 * em, {255, 255, 255});
  stage.over.disc(at, 0.14 * em, axes_ink);
  stage.over.text({box.centre().x, box.top - 0.1 * em}, words, {.across = Align::middle, .up = Align::high, .colour = axes_ink, .halo = true});
}

void draw_notes(Stage& stage, vtkRenderer*) {
  for (const auto& [x0, y0, x1, y1] : stage.picture.marked) {
    const Point a = stage.view.flat({x0, y0, 0}), b = stage.view.flat({x1, y1, 0});
    const Box rim = stage.frame.grown(0.2 * stage.em);
    stage.over.outline({std::max(a.x, rim.left), std::max(a.y, rim.bottom), std::min(b.x, rim.right), std::min(b.y, rim.top)}, std::max(1.5, stage.em / 12), axes_ink);
  }
  std::vector<Box> taken;
  for (const Note& note : stage.picture.notes)
    if (stage.shows(stage.view.flat(note.position))) draw_note(stage, note, taken);
}

}  // namespace

Layer note_layer() { return {7, draw_notes}; }

}  // namespace dotyk::figure

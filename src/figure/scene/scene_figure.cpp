// A scene figure: three layers, one above the other. Obstacles of the plane
// below, then bodies in VTK's own renderer, then symbols, legends and texts.
#include <iterator>

#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "figure/canvas/osmesa.hpp"
#include "figure/canvas/sheet.hpp"
#include "figure/door/drawing.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

Stage::Stage(const ScenePicture& p, Point at)
    : picture(p), corner(at), factor(image_factor(p)), plane(p.bodies.front().dimension == 2), em(letters(p)),
      layers{contact_layer(), obstacle_layer(), load_layer(), support_layer(), isoline_layer(), trajectory_layer(), note_layer(), body_layer()} {
  under.origin(corner), over.origin(corner);
  if (p.window) window = asked = box_of(*p.window);
  scale = colour_scale(p, window);
  inset = inset_of(p, scale);
  set_greatest();
  for (const LoadArrow& load : p.loads) greatest_load = std::max(greatest_load, length(load.vector));
  greatest_load = std::max(greatest_load, p.longest[2]);
  for (const BodyPicture& body : p.bodies) {
    Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      least[i % 3] = std::min(least[i % 3], body.points[i]);
      most[i % 3] = std::max(most[i % 3], body.points[i]);
    }
    if (!body.points.empty()) body_boxes.push_back({least, most});
  }
}

double Stage::strip_height() const {
  const double wanted = window ? window_strip : std::clamp(0.12 * std::min(picture.width, picture.height), 2 * em, 4.5 * em);
  return plane ? std::min(wanted, view.scale * longest_strip) : wanted;
}

double Stage::per_pressure() const {
  const double most = std::max(greatest_pressure, greatest_shear);
  return most > 0 ? strip_height() / most : 0;
}

std::vector<bool> Stage::shown(const ContactPicture& contact) const {
  const std::vector<Point> at = this->at(contact.nodes);
  std::vector<bool> out;
  for (std::size_t i = 0; i < at.size(); ++i) out.push_back(shows(at[i]) && stays(contact.nodes[i]));
  if (!window || contact.nodes_per_facet != 2) return out;
  for (const auto& [a, b] : pairs(contact.facets))
    if (shows(at[a], at[b])) out[a] = out[b] = true;
  return out;
}

void Stage::set_greatest() {
  greatest_pressure = greatest_shear = 0;
  for (const ContactPicture& contact : picture.contacts) {
    const std::vector<bool> seen = shown(contact);
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i]) {
        if (contact.nodes[i].pressure > greatest_pressure) greatest_pressure = contact.nodes[i].pressure, sharp = contact.nodes[i].sharp;
        if (picture.shear) greatest_shear = std::max(greatest_shear, std::sqrt(dot(contact.nodes[i].shear, contact.nodes[i].shear)));
      }
  }
  if (greatest_shear < 1e-9 * greatest_pressure) greatest_shear = 0;  // rounding's
  if (greatest_pressure > 0) greatest_pressure = std::max(greatest_pressure, picture.longest[0]);
  if (greatest_shear > 0) greatest_shear = std::max(greatest_shear, picture.longest[1]);
  // The ends of ordinates of neighbours must go the way of their feet: x + h p n with at most 0.7 of the h that stops them.
  longest_strip = INFINITY;
  for (const ContactPicture& contact : picture.contacts) {
    if (!plane || contact.nodes_per_facet != 2) continue;
    const std::vector<bool> seen = shown(contact);
    for (const auto& [i, j] : pairs(contact.facets)) {
      const ContactNode &a = contact.nodes[i], &b = contact.nodes[j];
      if (!seen[i] || !seen[j] || !(a.pressure > 0) || !(b.pressure > 0)) continue;
      const Vec3 way = plus(place(b), place(a), -1), back = plus(plus({0, 0, 0}, a.normal, a.pressure), b.normal, -b.pressure);
      const Vec3 outward = unit(plus(a.normal, b.normal)), along = plus(way, outward, -dot(way, outward));
      if (const double closing = dot(along, back); closing > 0) longest_strip = std::min(longest_strip, 0.7 * dot(along, way) / closing * std::max(greatest_pressure, greatest_shear));
    }
  }
}

std::vector<std::size_t> Stage::spaced(const std::vector<Point>& positions, double spacing, double within) const {
  std::vector<Point> at;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (shows(positions[i], within)) at.push_back(positions[i]), numbers.push_back(i);
  std::vector<std::size_t> out = spread(at, spacing);
  for (std::size_t& i : out) i = numbers[i];
  return out;
}

namespace {

// The bodies' renderer works in rendered pixels and sees the frame only.
void set_camera(const Stage& stage, vtkRenderer* renderer) {
  const double w = stage.picture.width, h = stage.picture.height, f = stage.factor;
  const Box frame = stage.plane && !stage.window ? Box{0, 0, w, h} : stage.frame;
  renderer->SetViewport(frame.left / w, frame.bottom / h, frame.right / w, frame.top / h);
  const double x = f * (frame.left + frame.right) / 2, y = f * (frame.bottom + frame.top) / 2;
  // Depths: bodies reach as far to and fro as across, about the origin's.
  double near = 1e300, far = -1e300;
  for (const auto& [least, most] : stage.body_boxes)
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? most[0] : least[0], corner & 2 ? most[1] : least[1], corner & 4 ? most[2] : least[2]};
      const double z = f * stage.view.pixel(p)[2];
      near = std::min(near, z), far = std::max(far, z);
    }
  const double reach = 4 * f * (w + h);
  near = stage.plane ? 0 : (near + far) / 2;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(f * frame.height() / 2);
  camera->SetFocalPoint(x, y, near);
  camera->SetPosition(x, y, near + reach);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(0.01 * reach, 2 * reach);
  vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.35, 0.55, 1);
  light->SetFocalPoint(0, 0, 0);
  renderer->AddLight(light);
}

void draw_layers(Stage& stage, vtkRenderer* bodies) {
  if (stage.window) stage.over.clip(stage.frame);
  std::vector<Layer> upwards = stage.layers;
  std::stable_sort(upwards.begin(), upwards.end(), [](const Layer& a, const Layer& b) { return a.height < b.height; });
  for (const Layer& layer : upwards)
    if (layer.draw) layer.draw(stage, bodies);
  stage.over.no_clip();
}

// A sheet without a given width becomes one of two columns where one will not do.
bool widened(Sheet& sheet) {
  const double before = printed_width(sheet);
  if (!sheet.printed) sheet.printed = two_columns;
  return printed_width(sheet) > before;
}

// Calls `finish` with the stage once the picture has room for all.
void with_stage(const ScenePicture& picture, const std::function<void(Stage&)>& prepare, const std::function<void(Stage&)>& finish) {
  ScenePicture grown = picture;
  constexpr int kRounds = 4;  // the column beside the scene depends on the height
  for (int round = 1;; ++round) {
    Stage stage(grown);
    if (prepare) prepare(stage);
    const double missing = lay_out(stage);
    if (const double lacks = lacking_width(stage); lacks > 0) {
      if (widened(grown)) continue;
      refuse_narrow(grown, lacks);
    }
    if (round == kRounds || !(missing > 1)) return finish(stage);
    grown.height = std::min(std::max(grown.height, greatest_side), grown.height + static_cast<int>(std::ceil(missing)));
  }
}

}  // namespace

std::vector<Painted> painted(Stage& stage) {
  vtkNew<vtkRenderer> bodies;
  draw_layers(stage, bodies);
  if (stage.picture.cut) cut_bodies(stage, bodies);
  // The rim of a window, above what it cuts off.
  if (stage.window) stage.over.outline(stage.frame, std::max(1.0, stage.em / 20), {30, 30, 30});
  Painted whole{std::move(stage.under), {}, Box{0, 0, 1.0 * stage.picture.width, 1.0 * stage.picture.height}.moved(stage.corner), std::move(stage.over)};
  if (bodies->GetActors()->GetNumberOfItems() > 0) {
    set_camera(stage, bodies);
    whole.image = rendered(stage.picture, bodies);
  }
  std::vector<Painted> parts{std::move(whole)};
  std::move(stage.insets.begin(), stage.insets.end(), std::back_inserter(parts));
  return parts;
}

void draw_scene(const ScenePicture& picture, const std::function<void(Stage&)>& prepare) {
  with_stage(picture, prepare, [](Stage& stage) { write_picture(stage.picture, painted(stage)); });
}

std::vector<DataMark> read_scene(const ScenePicture& picture, const std::function<void(Stage&)>& prepare) {
  std::vector<DataMark> out;
  with_stage(picture, prepare, [&](Stage& stage) {
    vtkNew<vtkRenderer> unseen;
    draw_layers(stage, unseen);
    out = stage.over.told();
    for (const LegendEntry& entry : stage.entries) out.push_back({"legend: " + entry.name, {}});
  });
  return out;
}

void render(const ScenePicture& picture) { draw_scene(picture); }
std::vector<DataMark> read(const ScenePicture& picture) { return read_scene(picture); }

}  // namespace dotyk::figure

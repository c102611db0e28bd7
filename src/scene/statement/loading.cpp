#include "scene/statement/loading.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/model/row_builder.hpp"

namespace dotyk::scene {
namespace {

void require_case(const Scene& scene, const std::string& name) {
  const auto known = load_cases(scene);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "'" : ", '") + one + "'";
  throw InputError(text("no load of the scene is of the case '", name, "'; ",
                        all.empty() ? "none is of any: name it where the load is given, part:load({ 0, -1 }, \"press\")"
                                    : "its cases are " + all));
}

int rigid_contact(const Scene& scene, const Contact& contact) {
  const int index = scene.index_of(contact);
  if (index < 0) throw InputError(text("the ", contact.name, " is not of this scene"));
  if (contact.second.body || contact.kind == Contact::Kind::glue)
    throw InputError(text("the ", contact.name, " has no rigid shape to move; displace a part of a body instead"));
  return index;
}

}  // namespace

double Loading::of(const std::string& load_case) const {
  const auto found = factor.find(load_case);
  return found == factor.end() ? all : found->second;
}

mesh::Point Loading::move_of(int contact) const {
  const auto found = move.find(contact);
  return found == move.end() ? mesh::Point{0, 0, 0} : found->second;
}

void Loading::take(const Step& step, const Scene& scene) {
  if (step.all) {
    all = *step.all;
    factor.clear();
  }
  for (const auto& [name, value] : step.factor) {
    require_case(scene, name);
    factor[name] = value;
  }
  for (const auto& [contact, by] : step.move) move[rigid_contact(scene, *contact)] = by;
}

Body Loading::applied_to(const Body& body) const {
  Body scaled = body;
  const double rest = of("");
  for (double& f : scaled.force) f *= rest;
  if (scaled.volume_load) scaled.volume_load->factor *= rest;
  for (const LoadCase& one : body.cases) {
    if (one.force.empty()) continue;
    std::vector<double>& force = nodal_loads(scaled);
    const double factor = of(one.name);
    for (std::size_t k = 0; k < force.size(); ++k) force[k] += factor * one.force[k];
  }
  scaled.cases.clear();
  for (Support& support : scaled.supports)
    for (mesh::Point& value : support.values)
      for (double& v : value) v *= of(support.load_case);
  for (LawSupport& support : scaled.laws)
    for (problem::LawAlong* law : {&support.normal, &support.tangential})
      law->scale(rest);
  add_law_loads(scaled);
  for (FacetLoad& load : scaled.facet_loads) {
    for (double& v : load.values) v *= of(load.load_case);
    load.load_case.clear();
  }
  return scaled;
}

std::shared_ptr<const Contact> Loading::applied_to(const std::shared_ptr<const Contact>& contact) const {
  const double rest = of("");
  if (rest == 1 || !contact->normal.moves()) return contact;
  auto scaled = std::make_shared<Contact>(*contact);
  scaled->normal.scale(rest);
  return scaled;
}

std::vector<std::string> load_cases(const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const auto& body : scene.bodies) {
    for (const LoadCase& one : body->cases) add(one.name);
    for (const Support& support : body->supports) add(support.load_case);
  }
  return names;
}

}  // namespace dotyk::scene

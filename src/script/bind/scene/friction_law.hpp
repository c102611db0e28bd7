#pragma once

#include <optional>

#include "script/bind/models/bind_beam.hpp"
#include "script/bind/scene/space.hpp"
#include "script/bridge/call.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {

// The law of dotyk.friction given as `name`; `field` owns a function of it during the call.
inline scene::Friction friction(Call& call, const char* name, int dimension, std::optional<Field>& field) {
  if (!call.holds<FrictionLaw>(name)) return {};
  const auto law = call.object<FrictionLaw>(name);
  if (!law->varies) return {law->kind, [value = law->value](const mesh::Point&) { return value; }};
  field.emplace(call.kept_function(call.slot(name), "value").at(0), 1);
  return {law->kind, scalar_field(*field, dimension)};
}

// A key for a law along the tangents.
inline Key tangential_key(const char* help) {
  return key::either("tangential", {key::object<problem::SupportLaw>("", ""), key::object<FrictionLaw>("", "")}, help).otherwise("free");
}

}  // namespace dotyk::script

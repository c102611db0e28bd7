#pragma once
// Keys that all that draws has in common.
#include "figure/compose/compose_beam.hpp"
#include "figure/door/picture.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {

inline Key picture_key() { return key::file("file", "where to; ends in .png, its folder must exist").written().required(); }
inline Key title_key(const char* help = "above the figure") { return key::string("title", help).otherwise("none"); }
inline Key size_key(const char* otherwise) {
  return key::list("size", key::integer("", ""), "width and height").count(2).unit("pixels").otherwise(otherwise);
}

// File, title, and size where it is given. Throws InputError where a side of that is out of range.
inline void read_page(const Arguments& call, figure::Sheet& sheet) {
  call.read("file", sheet.file);
  call.read("title", sheet.title);
  if (!call.has("size")) return;
  const auto size = call.integers("size");
  for (const long long pixels : size)
    if (pixels < 160 || pixels > 8192) throw InputError(text("size has ", pixels, " pixels; a side must have from 160 to 8192"));
  sheet.width = static_cast<int>(size[0]), sheet.height = static_cast<int>(size[1]);
}

// Draws what read_page() completes; gives the file.
template <class Picture>
std::string draw(const Call& call, Picture picture) {
  read_page(call, picture);
  figure::draw(picture);
  return picture.file;
}

// The direction towards the eye, given as `name`. Throws InputError where it is zero.
inline std::optional<figure::Vec3> read_direction(const Arguments& call, const char* name) {
  std::optional<figure::Vec3> direction;
  call.read(name, direction);
  if (direction == figure::Vec3{0, 0, 0}) throw InputError(text("'", name, "' is zero; it must have a direction"));
  return direction;
}

// Whether edges are drawn; `otherwise` where "edges" is not given.
inline figure::MeshEdges read_edges(const Arguments& call, figure::MeshEdges otherwise) {
  if (!call.has("edges")) return otherwise;
  return call.boolean("edges") ? figure::MeshEdges::on : figure::MeshEdges::off;
}

// Names of the units of length and force, of temperature too where there is `heat`.
inline Key units_key(bool heat = false) {
  using figure::Units;
  std::vector<Key> keys = {key::string("length", "\"m\"").otherwise("none").into(&Units::length), key::string("force", "\"kN\"").otherwise("none").into(&Units::force)};
  if (heat) keys.push_back(key::string("temperature", "\"K\"").otherwise("none").into(&Units::temperature));
  return key::table("units", std::move(keys), "names of the units, written beside the axes");
}
inline figure::Units read_units(const Arguments& call) { return call.has("units") ? call.table("units").filled<figure::Units>() : figure::Units{}; }

}  // namespace dotyk::script

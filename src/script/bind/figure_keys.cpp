#include "script/bind/figure_keys.hpp"

#include "script/bind/bind.hpp"

namespace dotyk::script {

Key picture_key() { return key::file("file", "where to; ends in .png, its folder must exist").written().required(); }

Key title_key(const char* help) { return key::string("title", help).otherwise("none"); }

Key size_key(const char* otherwise) {
  return key::list("size", key::integer("", ""), "width and height").count(2).unit("pixels").otherwise(otherwise);
}

void read_page(const Arguments& call, figure::Sheet& sheet) {
  call.read("file", sheet.file);
  call.read("title", sheet.title);
  if (!call.has("size")) return;
  const auto size = call.integers("size");
  for (const long long pixels : size)
    if (pixels < 160 || pixels > 8192)
      throw InputError(text("size has ", pixels, " pixels; a side must have from 160 to 8192"));
  sheet.width = static_cast<int>(size[0]), sheet.height = static_cast<int>(size[1]);
}

std::optional<figure::Vec3> read_direction(const Arguments& call, const char* name) {
  std::optional<figure::Vec3> direction;
  call.read(name, direction);
  if (direction == figure::Vec3{0, 0, 0}) throw InputError(text("'", name, "' is zero; it must have a direction"));
  return direction;
}

figure::MeshEdges read_edges(const Arguments& call, figure::MeshEdges otherwise) {
  if (!call.has("edges")) return otherwise;
  return call.boolean("edges") ? figure::MeshEdges::on : figure::MeshEdges::off;
}

Key units_key(bool heat) {
  using figure::Units;
  std::vector<Key> keys = {key::string("length", "\"m\"").otherwise("none").into(&Units::length), key::string("force", "\"kN\"").otherwise("none").into(&Units::force)};
  if (heat) keys.push_back(key::string("temperature", "\"K\"").otherwise("none").into(&Units::temperature));
  return key::table("units", std::move(keys), "names of the units, written beside the axes");
}

figure::Units read_units(const Arguments& call) { return call.has("units") ? call.table("units").filled<figure::Units>() : figure::Units{}; }

}  // namespace dotyk::script

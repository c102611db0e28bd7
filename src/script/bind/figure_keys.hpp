#pragma once
// Keys that all that draws has in common.
#include "figure/compose/compose_beam.hpp"
#include "figure/door/picture.hpp"
#include "script/bind/bind.hpp"

namespace dotyk::script {

inline Key picture_key() { return key::file("file", "where to; ends in .png, .pdf or .svg, its folder must exist").written().required(); }
inline Key title_key(const char* help = "above the figure") { return key::string("title", help).otherwise("none"); }
inline std::vector<Key> size_keys(const char* otherwise) {
  return {key::list("size", key::integer("", ""), "width and height, which is more where panels would be lower than 30 mm; of .pdf and .svg the proportions").count(2).unit("pixels").otherwise(text(otherwise, "; with 'width' 300 an inch")),
          key::number("width", "on paper, from 30 to 500: letters are made to be read at this width").unit("mm").otherwise("85, one column of a journal; of more than 1300 pixels 178, two")};
}

// File, title, and sizes where they are given. Throws InputError where one is out of range.
inline void read_page(const Arguments& call, figure::Sheet& sheet) {
  call.read("file", sheet.file);
  call.read("title", sheet.title);
  call.read("width", sheet.printed);
  if (sheet.printed && !(*sheet.printed >= figure::least_printed && *sheet.printed <= figure::greatest_printed))
    throw InputError(text("'width' is ", *sheet.printed, " mm; it must be from ", figure::least_printed, " to ", figure::greatest_printed));
  if (call.has("size")) {
    const auto size = call.integers("size");
    for (const long long pixels : size)
      if (pixels < figure::least_side || pixels > figure::greatest_side)
        throw InputError(text("size has ", pixels, " pixels; a side must have from ", figure::least_side, " to ", figure::greatest_side));
    sheet.width = static_cast<int>(size[0]), sheet.height = static_cast<int>(size[1]);
  } else if (sheet.printed) {
    constexpr double kDots = 300 / 25.4;  // a mm
    const double shape = static_cast<double>(sheet.height) / sheet.width;
    sheet.width = static_cast<int>(std::lround(kDots * *sheet.printed)), sheet.height = std::clamp(static_cast<int>(std::lround(shape * sheet.width)), figure::least_side, figure::greatest_side);
  }
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

#include "script/bind/figure_size.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::script {

Key size_key(const char* otherwise) {
  return key::list("size", key::integer("", ""), "width and height").count(2).unit("pixels").otherwise(otherwise);
}

void read_size(const Arguments& call, int& width, int& height) {
  if (!call.has("size")) return;
  const auto size = call.integers("size");
  for (const long long pixels : size)
    if (pixels < 160 || pixels > 8192)
      throw InputError(text("size has ", pixels, " pixels; a side must have from 160 to 8192"));
  width = static_cast<int>(size[0]);
  height = static_cast<int>(size[1]);
}

Key units_key(bool heat) {
  std::vector<Key> keys = {key::string("length", "\"m\"").otherwise("none"), key::string("force", "\"kN\"").otherwise("none")};
  if (heat) keys.push_back(key::string("temperature", "\"K\"").otherwise("none"));
  return key::table("units", std::move(keys), "names of the units, written beside the axes");
}

figure::Units read_units(const Arguments& call, bool heat) {
  if (!call.has("units")) return {};
  const Arguments given = call.table("units");
  const auto name = [&](const char* unit) { return given.has(unit) ? given.text(unit) : ""; };
  return {name("length"), name("force"), heat ? name("temperature") : ""};
}

}  // namespace dotyk::script

#include "script/figure_size.hpp"

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

}  // namespace dotyk::script

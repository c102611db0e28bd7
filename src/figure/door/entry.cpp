// The door of the drawing library. No exception passes it: an error is
// a text in `error` and a result other than 0.
#include <cstdio>
#include <exception>

#include "base/whole_file.hpp"
#include "figure/door/drawing.hpp"

extern "C" __attribute__((visibility("default"))) int dotyk_figure_draw(const dotyk::figure::Drawing* drawing, double* file_bytes_left, char* error, std::size_t size) {
  dotyk::file_bytes_left = *file_bytes_left;
  int failed = 1;
  try {
    std::visit([](const auto* picture) { dotyk::figure::render(*picture); }, *drawing);
    failed = 0;
  } catch (const std::exception& e) {
    std::snprintf(error, size, "%s", e.what());
  } catch (...) {
    std::snprintf(error, size, "the drawing library failed for an unknown reason");
  }
  *file_bytes_left = dotyk::file_bytes_left;
  return failed;
}

// The door of the drawing library. No exception passes it: an error is
// a text in `error` and a result other than 0.
#include <cstdio>
#include <exception>

#include "figure/door/drawing.hpp"

extern "C" __attribute__((visibility("default"))) int dotyk_figure_draw(const dotyk::figure::Drawing* drawing, char* error, std::size_t size) {
  try {
    std::visit([](const auto* picture) { dotyk::figure::render(*picture); }, *drawing);
    return 0;
  } catch (const std::exception& e) {
    std::snprintf(error, size, "%s", e.what());
  } catch (...) {
    std::snprintf(error, size, "the drawing library failed for an unknown reason");
  }
  return 1;
}

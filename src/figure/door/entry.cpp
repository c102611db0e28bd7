// The doors of the drawing library. No exception passes them: an error is
// a text in `error` and a result other than 0.
#include <cstdio>
#include <exception>

#include "figure/door/figures.hpp"

namespace {

template <class Work>
int guarded(Work work, char* error, int size) {
  try {
    work();
    return 0;
  } catch (const std::exception& e) {
    std::snprintf(error, static_cast<std::size_t>(size), "%s", e.what());
  } catch (...) {
    std::snprintf(error, static_cast<std::size_t>(size), "the drawing library failed for an unknown reason");
  }
  return 1;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int dotyk_figure_draw_scene(const dotyk::figure::ScenePicture* picture, char* error, int size) {
  return guarded([&] { dotyk::figure::draw_scene(*picture); }, error, size);
}

__attribute__((visibility("default"))) int dotyk_figure_draw_chart(const dotyk::figure::ChartPicture* picture, char* error, int size) {
  return guarded([&] { dotyk::figure::draw_chart(*picture); }, error, size);
}

__attribute__((visibility("default"))) int dotyk_figure_draw_charts(const dotyk::figure::ChartColumn* picture, char* error, int size) {
  return guarded([&] { dotyk::figure::draw_charts(*picture); }, error, size);
}

__attribute__((visibility("default"))) int dotyk_figure_draw_page(const dotyk::figure::PagePicture* picture, char* error, int size) {
  return guarded([&] { dotyk::figure::draw_page(*picture); }, error, size);
}

__attribute__((visibility("default"))) int dotyk_figure_draw_plate(const dotyk::figure::PlatePicture* picture, char* error, int size) {
  return guarded([&] { dotyk::figure::draw_plate(*picture); }, error, size);
}

__attribute__((visibility("default"))) int dotyk_figure_write_grid(const dotyk::figure::GridFile* grid, char* error, int size) {
  return guarded([&] { dotyk::figure::write_grid(*grid); }, error, size);
}

}  // extern "C"

// Opens the drawing library at the first picture: linked to VTK the program
// would take ten times as long to start.
#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "base/open_library.hpp"
#include "figure/door/check.hpp"
#include "figure/door/grid_file.hpp"
#include "figure/page/page_picture.hpp"
#include "figure/door/picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

namespace {

template <class Picture>
using Draw = int (*)(const Picture*, char* error, int size);

struct Library {
  Draw<ScenePicture> scene = nullptr;
  Draw<ChartPicture> chart = nullptr;
  Draw<ChartColumn> charts = nullptr;
  Draw<PagePicture> page = nullptr;
  Draw<PlatePicture> plate = nullptr;
  Draw<GridFile> grid = nullptr;
};

void* open() {
  SharedLibrary drawing{"libdotyk_figure_vtk.so", "the drawing library", 280e6, DOTYK_FIGURE_LIBDIR, ""};  // measured: 250 MB
#ifdef DOTYK_FIGURE_BUILD_LIBRARY
  drawing.built = DOTYK_FIGURE_BUILD_LIBRARY;
#endif
  const LibraryPlace place = look_for(drawing);
  if (place.found.empty()) throw std::runtime_error("pictures and .vtu files need " + drawing.what + " " + drawing.file + ", which is missing:" + place.tried);
  return open_library(drawing, place.found);
}

const Library& library() {
  static const Library opened = [] {
    void* handle = open();
    Library l;
    l.scene = reinterpret_cast<Draw<ScenePicture>>(dlsym(handle, "dotyk_figure_draw_scene"));
    l.chart = reinterpret_cast<Draw<ChartPicture>>(dlsym(handle, "dotyk_figure_draw_chart"));
    l.charts = reinterpret_cast<Draw<ChartColumn>>(dlsym(handle, "dotyk_figure_draw_charts"));
    l.page = reinterpret_cast<Draw<PagePicture>>(dlsym(handle, "dotyk_figure_draw_page"));
    l.plate = reinterpret_cast<Draw<PlatePicture>>(dlsym(handle, "dotyk_figure_draw_plate"));
    l.grid = reinterpret_cast<Draw<GridFile>>(dlsym(handle, "dotyk_figure_write_grid"));
    if (!l.scene || !l.chart || !l.charts || !l.page || !l.plate || !l.grid) throw std::runtime_error("the drawing library is of another version of dotyk");
    return l;
  }();
  return opened;
}

template <class Picture>
void call(Draw<Picture> Library::*function, const Picture& picture) {
  check(picture);
  char error[1024] = "";
  if ((library().*function)(&picture, error, sizeof error) != 0) throw std::runtime_error(error);
}

}  // namespace

void draw(const ScenePicture& picture) { call(&Library::scene, picture); }
void draw(const ChartPicture& picture) { call(&Library::chart, picture); }
void draw(const ChartColumn& picture) { call(&Library::charts, picture); }
void draw(const PagePicture& picture) { call(&Library::page, picture); }
void draw(const PlatePicture& picture) { call(&Library::plate, picture); }
void write(const GridFile& grid) { call(&Library::grid, grid); }

}  // namespace dotyk::figure

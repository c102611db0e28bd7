// Opens the drawing library at the first picture: linked to VTK the program
// would take ten times as long to start.
#include <dlfcn.h>
#include <unistd.h>

#include <climits>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/memory.hpp"
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

std::string program_folder() {
  char path[PATH_MAX];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path);
  const std::string program(path, n > 0 ? static_cast<std::size_t>(n) : 0);
  return program.substr(0, program.rfind('/') == std::string::npos ? 0 : program.rfind('/'));
}

void* open_library() {
  const std::string name = "libdotyk_figure_vtk.so";
  const std::string here = program_folder();
  std::vector<std::string> places = {here + "/" + name, here + "/../lib/dotyk/" + name,
                                     here + "/../" DOTYK_FIGURE_LIBDIR "/dotyk/" + name};
#ifdef DOTYK_FIGURE_BUILD_LIBRARY
  places.push_back(DOTYK_FIGURE_BUILD_LIBRARY);
#endif
  std::string tried;
  for (const std::string& place : places) {
    if (access(place.c_str(), R_OK) != 0) {
      tried += "\n  not at " + place;
      continue;
    }
    require_address_space(280e6, "the drawing library");  // measured: 250 MB
    if (void* handle = dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
    const char* reason = dlerror();
    for (const char* short_of : {"failed to map", "cannot allocate", "Cannot allocate"})
      if (reason && std::strstr(reason, short_of)) throw std::runtime_error("out of memory: the drawing library takes more than there is left");
    throw std::runtime_error("cannot open the drawing library " + place + ": " + (reason ? reason : "unknown reason"));
  }
  throw std::runtime_error("pictures and .vtu files need the drawing library " + name + ", which is missing:" + tried);
}

const Library& library() {
  static const Library opened = [] {
    void* handle = open_library();
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

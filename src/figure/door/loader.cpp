// Opens the drawing library at the first picture: linked to VTK the program
// would take ten times as long to start.
#include <dlfcn.h>

#include <stdexcept>

#include "base/open_library.hpp"
#include "base/whole_file.hpp"
#include "figure/door/drawing.hpp"

namespace dotyk::figure {

namespace {

using Door = int (*)(const Drawing*, double* file_bytes_left, char* error, std::size_t size);

void* open() {
  SharedLibrary drawing{"libdotyk_figure_vtk.so", "the drawing library", 280e6, DOTYK_FIGURE_LIBDIR, ""};  // measured: 250 MB
#ifdef DOTYK_FIGURE_BUILD_LIBRARY
  drawing.built = DOTYK_FIGURE_BUILD_LIBRARY;
#endif
  const LibraryPlace place = look_for(drawing);
  if (place.found.empty()) throw std::runtime_error("pictures and .vtu files need " + drawing.what + " " + drawing.file + ", which is missing:" + place.tried);
  return open_library(drawing, place.found);
}

Door door() {
  static const Door opened = reinterpret_cast<Door>(dlsym(open(), "dotyk_figure_draw"));
  if (!opened) throw std::runtime_error("the drawing library is of another version of dotyk");
  return opened;
}

template <class Picture>
void pass(const Picture& picture) {
  check(picture);
  const Drawing drawing = &picture;
  char error[1024] = "";
  if (door()(&drawing, &file_bytes_left, error, sizeof error) != 0) throw std::runtime_error(error);
}

template <class Picture>
std::vector<DataMark> marks_of(const Picture& picture) {
  std::vector<DataMark> out;
  pass(Reading{&picture, &out});
  return out;
}

}  // namespace

void draw(const ScenePicture& picture) { pass(picture); }
void draw(const SceneGrid& grid) { pass(grid); }
void draw(const ChartPicture& picture) { pass(picture); }
void draw(const ChartColumn& picture) { pass(picture); }
void draw(const PagePicture& picture) { pass(picture); }
void draw(const PlatePicture& picture) { pass(picture); }
void write(const GridFile& grid) { pass(grid); }
std::vector<DataMark> marks(const ScenePicture& picture) { return marks_of(picture); }
std::vector<DataMark> marks(const PagePicture& picture) { return marks_of(picture); }
std::vector<DataMark> marks(const PlatePicture& picture) { return marks_of(picture); }
std::vector<DataMark> marks(const ChartPicture& picture) { return marks_of(picture); }

}  // namespace dotyk::figure

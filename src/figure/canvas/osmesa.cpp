// Debian's VTK 9.1 has neither an OSMesa nor an EGL window, so we lend it a
// context of our own through vtkGenericOpenGLRenderWindow. VTK loads OpenGL
// with a GLEW built for GLX; three symbols of this library, which the dynamic
// linker finds before the originals, turn that GLEW to OSMesa.
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <memory>
#include <stdexcept>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "figure/canvas/osmesa.hpp"

using GlFunction = void (*)();

extern "C" {

__attribute__((visibility("default"))) GlFunction glXGetProcAddress(const unsigned char* name) {
  return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}

__attribute__((visibility("default"))) GlFunction glXGetProcAddressARB(const unsigned char* name) {
  return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}

// GLEW loads all of OpenGL, then complains that there is no GLX display.
__attribute__((visibility("default"))) unsigned int glewInit() {
  constexpr unsigned int ok = 0, failed = 1, no_glx_display = 4;
  const auto next = reinterpret_cast<unsigned int (*)()>(dlsym(RTLD_NEXT, "glewInit"));
  if (!next) return failed;
  const unsigned int code = next();
  return code == no_glx_display ? ok : code;
}

}  // extern "C"

namespace dotyk::figure {

namespace {

/// Mesa and VTK crash where they do not get the memory for their buffers (measured: 44 to 69 bytes a pixel and 50 MB; a stack each for
/// Mesa's threads, one a core, 16 at most).
void require_room(int width, int height) {
  const int threads = std::min(16, cores());
  require_address_space(150e6 + 10e6 * threads + 72.0 * width * height,
                        "a picture (drawn with " + std::to_string(width) + " x " + std::to_string(height) + " pixels, then reduced; smaller ones by 'size')");
}

void answer_is_current(vtkObject*, unsigned long, void*, void* answer) {
  *static_cast<bool*>(answer) = true;
}

struct ContextEnd {
  void operator()(OSMesaContext context) const {
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
    OSMesaDestroyContext(context);
  }
};

// Pixels with opacity, of an image of this size, the lowest row first.
std::vector<unsigned char> rendered(int width, int height, vtkRenderer* renderer) {
  require_room(width, height);
  std::vector<unsigned char> buffer(4 * static_cast<std::size_t>(width) * height);
  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24,
                            OSMESA_STENCIL_BITS, 0, OSMESA_ACCUM_BITS, 0,
                            OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 2, 0};
  const std::unique_ptr<osmesa_context, ContextEnd> context(OSMesaCreateContextAttribs(attributes, nullptr));
  if (!context) throw std::runtime_error("no OSMesa context for OpenGL 3.2 can be made");
  if (!OSMesaMakeCurrent(context.get(), buffer.data(), GL_UNSIGNED_BYTE, width, height))
    throw std::runtime_error("OSMesa cannot draw on a surface of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");

  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkCallbackCommand> current;
  current->SetCallback(answer_is_current);
  window->AddObserver(vtkCommand::WindowIsCurrentEvent, current);
  window->SetOwnContext(false);
  window->SetIsDirect(1);
  window->SetMapped(1);
  window->SetReadyForRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->SetDPI(72);
  window->SetAlphaBitPlanes(1);
  window->AddRenderer(renderer);
  renderer->SetBackground(0, 0, 0);  // so that colours come multiplied by their opacity
  renderer->SetBackgroundAlpha(0);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels.Get(), 0);
  window->Finalize();
  return {pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues()};
}

}  // namespace

Image rendered(const Sheet& sheet, vtkRenderer* renderer) {
  const int factor = image_factor(sheet), width = factor * sheet.width, height = factor * sheet.height;
  const std::vector<unsigned char> pixels = rendered(width, height, renderer);
  if (pixels.size() != 4 * static_cast<std::size_t>(width) * height) throw std::runtime_error("the drawing library returned a picture of another size");
  Image image{width, height, {}};
  image.rgba.reserve(pixels.size());
  const std::ptrdiff_t row = 4 * width;
  for (auto from = pixels.end(); from != pixels.begin(); from -= row) image.rgba.insert(image.rgba.end(), from - row, from);
  return image;
}

}  // namespace dotyk::figure

// Debian's VTK 9.1 has neither an OSMesa nor an EGL window, so we lend it a
// context of our own through vtkGenericOpenGLRenderWindow. VTK loads OpenGL
// with a GLEW built for GLX; three symbols of this library, which the dynamic
// linker finds before the originals, turn that GLEW to OSMesa.
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/whole_file.hpp"
#include "figure/canvas/canvas.hpp"

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

// Renders on white what layers hold, from the lowest to the highest: the rows of an image of this size.
std::vector<unsigned char> rendered(int width, int height, std::span<vtkRenderer* const> layers) {
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
  window->SetNumberOfLayers(static_cast<int>(layers.size()));
  for (std::size_t k = 0; k < layers.size(); ++k) {
    layers[k]->SetLayer(static_cast<int>(k));
    window->AddRenderer(layers[k]);
  }
  layers[0]->SetBackground(1, 1, 1);
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels.Get(), 0);
  window->Finalize();
  return {pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues()};
}

// The mean of each `factor` x `factor` block of an image that is `factor` times too large each way.
Image reduce(const std::vector<unsigned char>& fine, int width, int height, int factor) {
  const auto n = static_cast<std::size_t>(width);
  if (fine.size() != 3 * n * height * factor * factor)
    throw std::runtime_error("the drawing library returned a picture of another size");
  Image image{width, height, std::vector<unsigned char>(3 * n * height)};
  std::vector<std::uint32_t> sums(3 * n);
  const std::uint32_t count = factor * factor;
  for (int y = 0; y < height; ++y) {
    std::fill(sums.begin(), sums.end(), 0);
    for (int dy = 0; dy < factor; ++dy) {
      const unsigned char* row = &fine[3 * n * factor * (static_cast<std::size_t>(y) * factor + dy)];
      for (std::size_t x = 0; x < n; ++x)
        for (int dx = 0; dx < factor; ++dx, row += 3)
          for (int c = 0; c < 3; ++c) sums[3 * x + c] += row[c];
    }
    unsigned char* out = &image.rgb[3 * n * y];
    for (std::size_t k = 0; k < 3 * n; ++k) out[k] = static_cast<unsigned char>((sums[k] + count / 2) / count);
  }
  return image;
}

vtkSmartPointer<vtkUnsignedCharArray> encode(const Image& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::memcpy(data->GetScalarPointer(), image.rgb.data(), image.rgb.size());
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetCompressionLevel(4);
  writer->WriteToMemoryOn();
  writer->Write();
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  if (writer->GetResult()) bytes->DeepCopy(writer->GetResult());
  return bytes;
}

}  // namespace

void write_picture(const Sheet& sheet, std::span<vtkRenderer* const> layers, const Canvas& canvas) {
  const int factor = canvas.factor();
  Image image = reduce(rendered(factor * sheet.width, factor * sheet.height, layers), sheet.width, sheet.height, factor);
  canvas.set_texts(image);
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = encode(image);
  const auto size = static_cast<std::size_t>(bytes->GetNumberOfValues());
  if (size == 0) throw std::runtime_error("cannot encode " + sheet.file + " as PNG");
  PartFile part(sheet.file);
  part.write(bytes->GetPointer(0), size);
  part.finish();
}

}  // namespace dotyk::figure

#include "figure/canvas/image.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "base/whole_file.hpp"

namespace dotyk::figure {

int oversampling(int width, int height) {
  const double pixels = static_cast<double>(width) * height;
  if (pixels <= 2e6 && std::max(width, height) <= 5000) return 3;
  if (pixels <= 16e6 && std::max(width, height) <= 8000) return 2;
  return 1;
}

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

namespace {

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

void write_png(const Image& image, const std::string& file) {
  const vtkSmartPointer<vtkUnsignedCharArray> bytes = encode(image);
  const auto size = static_cast<std::size_t>(bytes->GetNumberOfValues());
  if (size == 0) throw std::runtime_error("cannot encode " + file + " as PNG");
  PartFile part(file);
  part.write(bytes->GetPointer(0), size);
  part.finish();
}

}  // namespace dotyk::figure

// An off-screen window for VTK: everything about OSMesa is behind this class.
#pragma once

#include <memory>
#include <vector>

class vtkRenderWindow;

namespace dotyk::figure {

class OsmesaWindow {
public:
  // width and height in rendered pixels. Throws std::runtime_error where no
  // context can be had.
  OsmesaWindow(int width, int height);
  ~OsmesaWindow();
  OsmesaWindow(const OsmesaWindow&) = delete;
  OsmesaWindow& operator=(const OsmesaWindow&) = delete;

  vtkRenderWindow* vtk();

  // Renders and returns width x height x 3 bytes (RGB), lowest row first.
  std::vector<unsigned char> render();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dotyk::figure

#include <stdexcept>

#include "figures.hpp"

namespace dotyk::figure {

void draw_scene(const ScenePicture&) { throw std::runtime_error("scenes are not drawn yet"); }

}  // namespace dotyk::figure

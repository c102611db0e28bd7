// What passes the door of the drawing library.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <variant>

#include "base/text.hpp"
#include "figure/door/marks.hpp"
#include "figure/door/picture.hpp"
#include "figure/page/page_picture.hpp"
#include "figure/plate/plate_picture.hpp"

namespace dotyk::figure {

// Asks for the marks of a picture in place of its file.
struct Reading {
  std::variant<const ScenePicture*, const PagePicture*, const PlatePicture*, const ChartPicture*> of;
  std::vector<DataMark>* marks;
};

using Drawing = std::variant<const ScenePicture*, const SceneGrid*, const ChartPicture*, const ChartColumn*, const PagePicture*, const PlatePicture*, const GridFile*, const Reading*>;

// Before the door: throw std::runtime_error naming what is wrong: sizes, lengths of arrays, node numbers, the file's ending
// and folder.
void check(const ScenePicture& picture);
void check(const SceneGrid& grid);
void check(const ChartPicture& picture);
void check(const ChartColumn& picture);
void check(const PagePicture& picture);
void check(const PlatePicture& picture);
void check(const GridFile& grid);
inline void check(const Reading& reading) { std::visit([](const auto* picture) { check(*picture); }, reading.of); }

// Behind it: draw, or write, and throw std::runtime_error; entry.cpp keeps exceptions from leaving the library.
void render(const ScenePicture& picture);
void render(const SceneGrid& grid);
void render(const ChartPicture& picture);
void render(const ChartColumn& picture);
void render(const PagePicture& picture);
void render(const PlatePicture& picture);
void render(const GridFile& grid);
std::vector<DataMark> read(const ScenePicture& picture);
std::vector<DataMark> read(const PagePicture& picture);
std::vector<DataMark> read(const PlatePicture& picture);
std::vector<DataMark> read(const ChartPicture& picture);
inline void render(const Reading& reading) { std::visit([&](const auto* picture) { *reading.marks = read(*picture); }, reading.of); }

template <class... Parts>
void require(bool holds, const Parts&... message) {
  if (!holds) throw std::runtime_error(text(message...));
}

inline bool finite(double value) { return std::isfinite(value); }
inline bool finite(std::span<const double> values) { return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }); }
template <class First, class... Rest>
bool finite(const First& first, const Rest&... rest) requires(sizeof...(Rest) > 0) { return finite(first) && (finite(rest) && ...); }

// Of every text that is drawn; `key` is what scripts call it.
void check_text(const std::string& key, const std::string& words);
void check_sheet(const Sheet& sheet);

}  // namespace dotyk::figure

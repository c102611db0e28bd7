#include <array>

#include "picture.hpp"

namespace dotyk::figure {

const char* status_name(Status status) {
  switch (status) {
    case Status::open: return "open";
    case Status::closed: return "closed";
    case Status::stick: return "stick";
    case Status::slip: return "slip";
  }
  return "";
}

// Okabe & Ito, Color Universal Design (2008).
Colour status_colour(Status status) {
  switch (status) {
    case Status::open: return {86, 180, 233};     // sky blue
    case Status::closed: return {213, 94, 0};     // vermilion
    case Status::stick: return {204, 121, 167};   // reddish purple
    case Status::slip: return {230, 159, 0};      // orange
  }
  return {};
}

Colour series_colour(int k) {
  static constexpr std::array<Colour, 7> colours{{
      {0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {60, 60, 60}}};
  return colours[static_cast<std::size_t>(k < 0 ? -k : k) % colours.size()];
}

}  // namespace dotyk::figure

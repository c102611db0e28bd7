#include <array>

#include "figure/page/page_picture.hpp"
#include "figure/plate/plate_picture.hpp"

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

const char* support_name(PlateSupport support) {
  switch (support) {
    case PlateSupport::free: return "free";
    case PlateSupport::held: return "held";
    case PlateSupport::one_sided: return "one-sided";
    case PlateSupport::elastic: return "elastic";
    case PlateSupport::friction: return "with friction";
  }
  return "";
}

const char* state_name(SupportState state) {
  switch (state) {
    case SupportState::acting: return "acting";
    case SupportState::open: return "open";
    case SupportState::pushing: return "pushing";
    case SupportState::pulling: return "pulling";
    case SupportState::stick: return "sticking";
    case SupportState::slip: return "slipping, at its limit";
    case SupportState::broken: return "broken";
  }
  return "";
}

// Those of contacts that mean the same have their colours.
Colour state_colour(SupportState state) {
  switch (state) {
    case SupportState::acting: return {100, 100, 100};
    case SupportState::open: return status_colour(Status::open);
    case SupportState::pushing: return status_colour(Status::closed);
    case SupportState::pulling: return {0, 158, 115};  // bluish green
    case SupportState::stick: return status_colour(Status::stick);
    case SupportState::slip: return status_colour(Status::slip);
    case SupportState::broken: return {0, 0, 0};
  }
  return {};
}

Colour series_colour(int k) {
  static constexpr std::array<Colour, 7> colours{{
      {0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {60, 60, 60}}};
  return colours[static_cast<std::size_t>(k < 0 ? -k : k) % colours.size()];
}

}  // namespace dotyk::figure

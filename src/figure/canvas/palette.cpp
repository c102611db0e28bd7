#include <cstdlib>

#include "figure/page/page_picture.hpp"

namespace dotyk::figure {

namespace {

struct Named {
  const char* name;
  Colour colour;
};

// Okabe & Ito, Color Universal Design (2008): sky blue, vermilion, reddish purple, orange.
constexpr Named statuses[] = {{"open", {86, 180, 233}}, {"closed", {213, 94, 0}}, {"stick", {204, 121, 167}}, {"slip", {230, 159, 0}}};

const Named& named(Status status) { return statuses[static_cast<std::size_t>(status)]; }

// Those of contacts that mean the same have their colours; what pulls is bluish green.
const Named& named(SupportState state) {
  static const Named states[] = {{"acting", {100, 100, 100}}, {"open", status_colour(Status::open)},
                                 {"pushing", status_colour(Status::closed)}, {"pulling", {0, 158, 115}},
                                 {"sticking", status_colour(Status::stick)}, {"slipping, at its limit", status_colour(Status::slip)},
                                 {"broken", {0, 0, 0}}};
  return states[static_cast<std::size_t>(state)];
}

}  // namespace

const char* status_name(Status status) { return named(status).name; }
Colour status_colour(Status status) { return named(status).colour; }
const char* state_name(SupportState state) { return named(state).name; }
Colour state_colour(SupportState state) { return named(state).colour; }

Colour series_colour(int k) {
  static constexpr Colour colours[] = {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}, {60, 60, 60}};
  return colours[std::abs(k) % std::size(colours)];
}

}  // namespace dotyk::figure

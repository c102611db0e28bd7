#pragma once
// The oscillating channel, as scripts hold it.
#include <optional>

#include "channel/series.hpp"
#include "channel/stepping.hpp"
#include "script/bridge/wrapped.hpp"

namespace dotyk::script {

// Without a series where the magnetic field oscillates too slowly for it; `refusal` says so.
struct ChannelFlow {
  channel::Data data;
  std::optional<channel::Series> series;
  std::string refusal;
};
template <>
struct Wrapped<ChannelFlow> {
  static constexpr const char* name = "channel";
};
template <>
struct Wrapped<channel::Stepping> {
  static constexpr const char* name = "channel_stepping";
};

}  // namespace dotyk::script

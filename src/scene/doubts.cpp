#include "scene/doubts.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace dotyk::scene {

namespace {

/// Gaps that chords make uncertain by more than this part of the interference, or of how gaps differ, give no pressure to rely on.
constexpr double kMostOfGap = 0.1;

/// Facets of curved parts whose nodes do not match are chords of different places: gaps are uncertain by the chords' height. Pressure comes from
/// the interference, or from what the gap differs by where bodies meet.
void see_chords(const Contact& contact, std::vector<std::string>& all) {
  if (contact.rows.empty() || !(contact.chord > 0)) return;
  const auto [least, most] = std::minmax_element(contact.rows.begin(), contact.rows.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
  const double scale = contact.interference ? std::max(0.0, -least->gap) : most->gap - least->gap;
  if (contact.chord <= std::max(kMostOfGap * scale, 1e-12 * contact.first.body->mesh->size())) return;
  const std::string of = contact.interference ? "the interference" : "what gaps differ by";
  all.push_back(text(contact.name, ": facets are chords up to ", contact.chord, " off the curve, ",
                     scale > contact.chord ? text(std::round(100 * contact.chord / scale), " % of ", of, ", ", scale) : scale > 0 ? text("no less than ", of, ", ", scale) : "which leaves nothing of " + of,
                     ": the pressure is ", contact.interference ? "too small or too great by as much, and uneven" : "that of the chords",
                     "; take cells of order 2 (P2, Q2), nodes that match, or finer facets"));
}

}  // namespace

std::vector<std::string> doubts(const Scene& scene) {
  std::vector<std::string> all;
  for (const auto& contact : scene.contacts) see_chords(*contact, all);
  return all;
}

std::string describe(const std::vector<std::string>& doubts) {
  std::string out;
  for (const std::string& one : doubts) out += "\n  warning: " + one;
  return out;
}

}  // namespace dotyk::scene

#pragma once

#include <string>
#include <vector>

#include "base/text.hpp"

namespace dotyk {

/// What a rigid motion is, for messages.
struct Motion {
  enum class Kind { translation, rotation };
  Kind kind = Kind::translation;
  /// Unit: of a translation; of the axis of a rotation in space; empty of one in the plane.
  std::vector<double> direction;
  std::vector<double> centre = {};  ///< of a rotation: the point that stays, in space one of its axis
  bool slides = false;              ///< a rotation, with a translation along its axis
  double amount = 1;                ///< a length, or an angle in radians; negative only of a rotation in the plane, clockwise

  /// "x", "-y": along a coordinate axis, "(0.6, 0.8)": along none.
  std::string direction_text() const;
  /// "translation along x", "rotation about (0.5, 0.5)", "rotation about the axis along z through (1, 1, 0)".
  std::string text() const;
};

/// So many times the motion.
inline Motion times(double factor, Motion motion) {
  motion.amount *= factor;
  if (motion.amount >= 0 || motion.direction.empty()) return motion;
  for (double& d : motion.direction) d = d == 0 ? 0 : -d;
  motion.amount = -motion.amount;
  return motion;
}

/// Is it along a coordinate axis?
inline bool along_axis(const std::vector<double>& direction) {
  int others = 0;
  for (const double d : direction) others += d != 0;
  return others == 1;
}

inline std::string Motion::direction_text() const {
  if (!along_axis(direction)) return point_text(direction.data(), static_cast<int>(direction.size()));
  std::string out;
  for (std::size_t i = 0; i < direction.size(); ++i)
    if (direction[i] != 0) out = std::string(direction[i] < 0 ? "-" : "") + "xyz"[i];
  return out;
}

inline std::string Motion::text() const {
  if (kind == Kind::translation) return "translation along " + direction_text();
  const std::string place = point_text(centre.data(), static_cast<int>(centre.size()));
  if (direction.empty()) return (amount < 0 ? "clockwise rotation about " : "rotation about ") + place;
  return "rotation about the axis along " + direction_text() + " through " + place +
         (slides ? " with a slide along it" : "");
}

inline std::vector<std::string> texts(const std::vector<Motion>& motions) {
  std::vector<std::string> out;
  for (const Motion& motion : motions) out.push_back(motion.text());
  return out;
}

}  // namespace dotyk

#pragma once

namespace dotyk {

/// Is a size nothing, or such that its powers, which methods compare, stay within the range of numbers: from 1/most to most?
inline bool moderate(double size, double most) { return size == 0 || (size <= most && size >= 1 / most); }

}  // namespace dotyk

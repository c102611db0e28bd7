#pragma once

#include <vector>

#include "scene/model/pieces.hpp"

namespace dotyk::scene {

/// For each piece the first one, or itself, of which it is a translate: the same cells on the same numbers of nodes,
/// the same material cell by cell, the same components held, no springs in the matrix, and nodes whose places relative to the
/// first node agree within 1e-12 of the least height of their cells. The matrix of one then serves for the other: its
/// entries are off by no more than some 1e-12 of the diagonal. What is off in truth is the rounding of coordinates:
/// some 1e-16 X/h for coordinates up to X and cells of size h, which the matrix has from them anyway. Where X/h is
/// beyond some thousands, translates may go unnoticed.
std::vector<int> congruent(const std::vector<Piece>& pieces);

}  // namespace dotyk::scene

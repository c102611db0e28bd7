#pragma once

#include "plate/model.hpp"

namespace dotyk::plate {

/// The nodes of a place in Plate::edges in order, counter-clockwise about the plate; of a closed line the first one comes again at the end.
std::vector<std::vector<int>> node_chains(const Model& model, int edge);

/// Rows of the samples in order along their edges: see Problem::chains.
std::vector<std::vector<int>> row_chains(const Model& model, const std::vector<Sample>& samples);

}  // namespace dotyk::plate

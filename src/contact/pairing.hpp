#pragma once

#include <optional>

#include "base/monitor.hpp"
#include "contact/across.hpp"

namespace dotyk::contact {

/// How points of the second part are found across from nodes of the first: at matching nodes; at the nodes' feet; or in the mean
/// over the multipliers' surroundings. See matching.hpp and across.hpp.
enum class Pairing { matching, node_to_segment, mortar };

struct PairedRows {
  Pairing pairing;
  std::vector<ContactRow> rows;
  bool turned = false;  ///< the rows are at nodes of `second`, their partners of `first`
};

/// The rows' chord is 0 where a node has one across from it, as matching nodes have: chords are the same there; and of order 2, whose
/// facets follow the curve.
/// Rows of contact by the pairing asked for; none asked for: at nodes where all match and facets are of one kind, else mortar. So that
/// the order of naming decides nothing, mortar's multipliers are those of the part that is coarser where the parts are nearest: on the
/// finer the pressure wavers (scripts/studies/accuracy/mortar.lua, P1: Hertz's contact 80 cells on 112, 0.9 of the error of matching nodes; the other way
/// round 1.4), and forces of friction are further off. Of two alike they are the first's; in order 2, where the choice makes some per cent
/// on coarse meshes, those of the part with the greater area. Nodes to segments are the finer part's: a coarser one's would let nodes
/// between them through. Where the second part lies above itself, the rows are the first's whatever the widths. Throws InputError
/// where nodes do not match though that was asked for, where parts do not face each other, and as matching_rows().
/// A mortar row's weight is the covered part's alone. Facets of curved parts that fit each other are chords of different
/// places: without `interference` an overlap of their height is taken as touching. `monitor` may be null; throws Interrupted.
PairedRows pair_rows(const Face& first, const Face& second, std::optional<Pairing> pairing,
                     const elasticity::ScalarField& added, bool interference, Monitor* monitor = nullptr);

struct PairedTies {
  Pairing pairing;
  std::vector<Tie> ties;
};

/// The same to tie parts together, one entry a node of the first part. Throws InputError where they lie apart by more than a tenth of a
/// facet's width and what chords of curved parts make of it.
PairedTies pair_ties(const Face& first, const Face& second, std::optional<Pairing> pairing, Monitor* monitor = nullptr);

}  // namespace dotyk::contact

#pragma once

#include "scene/model/row_builder.hpp"

namespace dotyk::scene {

/// Adds the rows of a body's support laws and notes them in the model (for all bodies, one after the other). Normal
/// rows measure u·n, tangential ones u·t, so that the reaction on the body is −λ along the row's direction; a node has no row in
/// a direction that other supports hold. Friction is given friction (Tresca), bound times share. Throws InputError where a
/// node that is held cannot obey a law: a prescribed displacement of another value, Signorini's below 0.
void add_support_rows(int body, RowBuilder& builder, Model& model);

/// The force of `load` laws on the body at a node.
mesh::Point law_load(const LawSupport& support, const contact::NodeSide& side, int dimension);
/// Adds the forces of the body's `load` laws to its nodal loads.
void add_law_loads(Body& body);

/// The energy ½g²/k (times share) that each broken support took.
double broken_energy(const Body& body);

}  // namespace dotyk::scene

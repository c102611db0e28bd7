#pragma once

#include "plate/held.hpp"
#include "problem/problem.hpp"

namespace dotyk::plate {

/// D at the points of every cell's stiffness_rule(): cells × points; of a constant those of one cell. Throws InputError where it is not positive.
std::vector<double> bending_stiffness(const Plate& plate);

struct Stiffness {
  algebra::SparseMatrix on_free;   ///< lower triangle, of the unknowns
  algebra::Vector force_of_held;   ///< K times the values of the held freedoms, on the unknowns
  double energy_of_held = 0;       ///< ½vᵀKv of them
};

/// ∫ D κᵀCκ of the mesh. `D`: as bending_stiffness() gives it; `unknown` of a freedom, −1: held.
Stiffness stiffness(const std::vector<double>& D, double nu, const Space& space, const Held& held, const std::vector<int>& unknown);

/// K u − load on the freedoms that are held, zero on others: what holds them. `u`: every freedom.
algebra::Vector holding_forces(const std::vector<double>& D, double nu, const Space& space, const Held& held, const algebra::Vector& load, const algebra::Vector& u);

/// A plate as a problem: one block on the freedoms that are not held, in lengths, so that all multipliers are forces. The kernel is what
/// is not held of 1, x and y. Rows, x = Bu − c: of laws of edges −v·unit (v a deflection: −v), of point supports and the obstacle −u.
struct Model {
  Plate plate;                     ///< without its functions: what they gave is in the model
  std::vector<double> D;           ///< see bending_stiffness()
  Space space;
  std::vector<Sample> deflections, rotations;  ///< points of edges at which laws act
  Held held;
  std::vector<int> unknown;        ///< of a freedom; −1 where it is held
  algebra::Vector load;            ///< of every freedom
  std::vector<int> point_row;      ///< of Plate::supports; −1: free or loaded
  std::vector<int> obstacle_row;   ///< of vertices; −1: none, or the edge's own law minds the obstacle; empty without one
  problem::Problem problem;
  double seconds = 0;              ///< that building it took

  /// Every freedom, from the problem's unknowns.
  algebra::Vector freedoms(const algebra::Vector& unknowns) const;
  /// The problem's unknowns among values of every freedom.
  algebra::Vector unknowns(const algebra::Vector& freedoms) const;
};

/// Calls the plate's functions, here and never again. Throws InputError as require_valid(), where D, the load or a law is not what it must be at some point, supports contradict each other, or a load
/// or support is off the plate.
Model build(Plate plate);

/// Adds the rows of the samples, point supports and obstacle to the model's problem. Where parts of the edge meet at a vertex, laws of one
/// kind act there together; a prescribed deflection outweighs all others, Signorini's law friction, which one point more or less
/// does not change. Throws InputError where what is held contradicts a one-sided law or the obstacle.
void add_rows(const Plate& plate, Model& model);

/// Which unknowns some row acts on.
std::vector<char> touched_by_rows(const problem::Problem& problem);

/// The nodes of a place in Plate::edges in order, counter-clockwise about the plate; of a closed line the first one comes again at the end.
std::vector<std::vector<int>> node_chains(const Model& model, int edge);

/// Rows of the samples in order along their edges: see Problem::chains.
std::vector<std::vector<int>> row_chains(const Model& model, const std::vector<Sample>& samples);

}  // namespace dotyk::plate

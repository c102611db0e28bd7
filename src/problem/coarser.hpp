#pragma once

#include <memory>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// Where nothing is hidden, the load that the slices have becomes the blocks': methods then need to know of no other.
void take_load_of_slices(Problem& problem);

/// How many are worth a level: the greatest number that a body has, without the last ones on which all bodies together have hardly fewer displacements. 0
/// where a body cannot tell functions of coarser meshes.
int coarser_meshes(const Problem& problem);
/// The functions of so many coarser meshes, all bodies together, the finest of these meshes first: see elasticity::coarse_functions().
std::vector<algebra::CoarseFunctions> coarse_functions(const Problem& problem);

/// A problem on the functions of the next coarser meshes: the same energy, rows and laws, of fewer displacements.
struct Coarser {
  Problem problem;
  /// By row: is it that of a node of the coarser mesh, by the greatest factor? Friction goes with its normal row. Rows under laws with numbers, as
  /// springs, are all kept: together they have the stiffness.
  std::vector<char> kept;
  std::vector<algebra::CoarseFunctions> functions;  ///< by block: the finer unknowns by the coarser ones

  /// What a state (u, λ) of this problem is on the finer mesh: u by the functions; the forces of all rows from those of the rows kept, by their densities.
  algebra::Vector finer_displacement(const algebra::Vector& u) const;
  algebra::Vector finer_forces(const algebra::Vector& lambda) const;
};
/// `stiffness`: PᵀKP of all blocks, P the functions of the next coarser meshes without the empty ones; computed where it is empty. Throws std::logic_error
/// where there are no coarser meshes.
Coarser coarser(const Problem& problem, algebra::SymmetricMatrix stiffness = {});

}  // namespace dotyk::problem

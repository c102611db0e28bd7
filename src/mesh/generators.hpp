#pragma once

#include <functional>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

enum class Family { p1, q1, p2, q2 };  ///< simplices or tensor cells, of order 1 or 2

/// Maps [0,1] onto [0,1], increasing; absent: even spacing.
using Grading = std::function<double(double)>;

/// A rectangle [from, to] of cells[0] × cells[1] cells. With P1 and P2 each cell is cut
/// from its lower left to its upper right corner. Parts: left right bottom top.
/// Throws InputError for cells < 1, to ≤ from, or a grading that is not increasing.
Mesh rectangle(const double from[2], const double to[2], const int cells[2], Family family,
               const Grading grading[2]);

/// A box; with P1 and P2 each cell is cut into the six tetrahedra along the edge paths
/// from its least to its greatest corner (Kuhn). Parts: left right (x), front
/// back (y), bottom top (z). Throws as `rectangle`.
Mesh box(const double from[3], const double to[3], const int cells[3], Family family,
         const Grading grading[3]);

/// A disc with `cells` cells along its radius. P1: concentric rings, 6 k edges on
/// ring k. Q1: a square core of cells × cells, and four blocks of cells × ⌈cells/2⌉
/// about it. P2, Q2: the same cells, their outer edges curved. Part: boundary (nodes exactly on the circle).
Mesh disc(const double center[2], double radius, int cells, Family family);

/// Tick positions of one graded axis: n + 1 values from a to b. `axis` is for the message.
std::vector<double> ticks(double a, double b, int n, const Grading& grading, const char* axis);

inline bool simplices(Family family) { return family == Family::p1 || family == Family::p2; }

}  // namespace dotyk::mesh

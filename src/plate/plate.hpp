#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "problem/law_choice.hpp"

namespace dotyk::plate {

/// Morley: quadratic on a cell, deflections of vertices and normal slopes of edge middles; nonconforming, error of order h in
/// energy. HCT (Hsieh, Clough and Tocher): cubic on a third of a cell, deflection and gradient of vertices and normal
/// slopes of edge middles; conforming, order h².
enum class Element { morley, hct };

/// Greatest |ν| for Morley's element. The energy holds back a nonconforming function by no more than (1 − |ν|)|∇²u|², so that its
/// consistency error is as h²/(1 − |ν|) in the deflection, where a conforming element sees ∫ det ∇²u of the boundary alone. Measured
/// against HCT (unit square, 16 × 16, simply supported and cantilevered): up to 0.8 five times the error at ν = 0.3, at 0.9 ten times, at 0.99 a hundred.
inline constexpr double kMostMorleyNu = 0.8;

const char* element_name(Element element);

/// Of a point of the plate.
using Field = std::function<double(double x, double y)>;
using LawField = std::function<problem::LawChoice(double x, double y)>;

/// What supports do along a part of the edge. Of laws per length: reaction, stiffness, bound and limit. A law of the
/// deflection u is about v = u, upwards; one of the rotation about v = ∂ₙu, n outwards, its reaction a moment per length that does work on ∂ₙu
/// (so it is −Mₙ of P5 (5)). One-sided laws keep u up (≥ 0) and ∂ₙu down (≤ 0).
struct EdgeSupport {
  std::string part;
  std::vector<mesh::Facet> facets;
  LawField deflection, rotation;  ///< empty: free
};

/// Of the deflection, at a point of the plate; it need not be a node.
struct PointSupport {
  double x = 0, y = 0;
  problem::LawChoice deflection;
};

struct PointLoad {
  double x = 0, y = 0;
  double force = 0;  ///< upwards
};

/// Along a segment within the plate.
struct LineLoad {
  double from[2] = {0, 0}, to[2] = {0, 0};
  double force = 0;  ///< per length, upwards
};

/// A thin plate under Kirchhoff's hypothesis (P5 2.2): minimise
///   ∫ ½D [(1 − ν)|∇²u|² + ν(Δu)²] − fu dx − loads + the supports' energies over u ∈ H²(Ω),
/// where u ≥ obstacle. Deflection u, forces and loads positive upwards.
/// Friction opposes the deflection (misprint 89 in scripts/papers/README.md, with others of P5). In its section 6 u counts downwards.
struct Plate {
  std::shared_ptr<const mesh::Mesh> mesh;  ///< triangles in the plane
  Element element = Element::morley;
  double D = 1;      ///< bending stiffness Eh³/12(1 − ν²), force·length; where there is no function
  Field D_of;        ///< empty: constant
  double nu = 0.3;   ///< −1 < ν < 1; Morley: at most kMostMorleyNu
  double f = 0;      ///< load per area; where there is no function
  Field f_of;        ///< empty: constant
  std::vector<PointLoad> point_loads;
  std::vector<LineLoad> line_loads;
  std::vector<EdgeSupport> edges;
  std::vector<PointSupport> supports;
  Field obstacle;    ///< height of what the plate may lie on; empty: none
};

/// Throws InputError where the mesh is not of triangles in the plane, a number is out of range, two of `edges` have a facet
/// in common, or a law is not one for plates (breaking ones are not).
void require_valid(const Plate& plate);

}  // namespace dotyk::plate

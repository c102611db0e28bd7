#pragma once
// Points and fields of scripts as the numerical rooms take them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "algebra/types.hpp"
#include "base/error.hpp"
#include "elasticity/load.hpp"
#include "script/bind/models/models.hpp"
#include "script/bridge/function.hpp"

namespace dotyk::script {

inline algebra::Vector vector_of(const std::vector<double>& v) { return Eigen::Map<const algebra::Vector>(v.data(), static_cast<Eigen::Index>(v.size())); }

// From its rows; throws InputError, which ends as said, where one of them has not so many numbers.
inline algebra::DenseMatrix dense_matrix(const std::vector<std::vector<double>>& rows, Eigen::Index columns, const char* what, const std::string& end) {
  algebra::DenseMatrix m(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (static_cast<Eigen::Index>(rows[i].size()) != columns)
      throw InputError(text("row ", i + 1, " of ", what, " has ", rows[i].size(), " numbers; ", end));
    m.row(static_cast<Eigen::Index>(i)) = vector_of(rows[i]);
  }
  return m;
}

inline mesh::Point point_of(const std::vector<double>& v) {
  mesh::Point p{0, 0, 0};
  for (std::size_t i = 0; i < v.size() && i < 3; ++i) p[i] = v[i];
  return p;
}

// Throws InputError unless the vector has as many components as the thing it belongs to has dimensions.
inline mesh::Point point_of(const std::vector<double>& v, int dimension, const std::string& what) {
  if (static_cast<int>(v.size()) != dimension)
    throw InputError(text("'", what, "' has ", v.size(), " components; it must have ", dimension, " here (", dimension, "-D)"));
  return point_of(v);
}

inline mesh::Point unit_vector(const std::vector<double>& v, const std::string& what) {
  mesh::Point p = point_of(v);
  const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  if (largest > 0)
    for (double& x : p) x /= largest;  // squares of the rest are then in range
  if (!(mesh::length(p) > 0)) throw InputError(text("'", what, "' is zero; it must have a direction"));
  return mesh::unit(p);
}

// Keys for a body and a point of it, and the point, whose z is given in space alone; throws InputError where it is not so.
inline std::vector<Key> point_keys(const char* x) {
  return {key::object<scene::Body>("body", "which body").required(), key::number("x", x).unit("length").required(),
          key::number("y", "its second coordinate").unit("length").required(), key::number("z", "in space only").unit("length")};
}
inline mesh::Point point_of(const Call& call, int dimension) {
  const bool space = dimension == 3;
  if (space != call.has("z")) throw InputError(space ? "z is missing: the scene is 3-D" : "z is given, but the scene is 2-D");
  return {call.number("x"), call.number("y"), space ? call.number("z") : 0};
}

// The functions below refer to Lua values: they are for use during the call only. Coordinates to new ones, to a number, to components:
inline auto point_map(Function map, int dimension) {
  return [map = std::move(map), n = static_cast<std::size_t>(dimension)](const mesh::Point& x) {
    mesh::Point y{0, 0, 0};
    map.numbers({x.data(), n}, {y.data(), n});
    return y;
  };
}

inline elasticity::ScalarField scalar_field(Field field, int dimension) {
  return [field = std::move(field), dimension](const mesh::Point& x) {
    double value;
    field.at({x.data(), static_cast<std::size_t>(dimension)}, {&value, 1});
    return value;
  };
}

inline elasticity::VectorField vector_field(Field field, int dimension) {
  return [field = std::move(field), n = static_cast<std::size_t>(dimension)](const mesh::Point& x) {
    mesh::Point value{0, 0, 0};
    field.at({x.data(), n}, {value.data(), n});
    return value;
  };
}

// The function `kept` with the object given as `name`.
inline elasticity::ScalarField kept_field(const Call& call, const char* name, const char* kept, int dimension) {
  return scalar_field(Field(call.kept_function(call.slot(name), kept).at(0), 1), dimension);
}

// The law given as `name`, else another.
inline scene::GivenLaw given_law(const Arguments& from, const char* name, int dimension, problem::LawChoice otherwise = {}) {
  scene::GivenLaw given(otherwise);
  if (LawOfPlace law = law_field(from, name))
    given.varies = [law = std::move(law), n = static_cast<std::size_t>(dimension)](const mesh::Point& x) { return law({x.data(), n}); };
  return given;
}

// Throws InputError where memory has no room for the mesh refined so many times, or solvers of one machine for its unknowns.
void require_room_to_refine(const mesh::Mesh& mesh, std::int64_t times);

// The field at every node: node × dimension.
inline std::vector<double> at_nodes(const Field& field, const mesh::Mesh& mesh) {
  const auto dimension = static_cast<std::size_t>(mesh.dimension());
  std::vector<double> values(mesh.coordinates.size());
  for (int n = 0; n < mesh.node_count(); ++n)
    field.at({mesh.node(n), dimension}, {&values[static_cast<std::size_t>(n) * dimension], dimension});
  return values;
}

}  // namespace dotyk::script

#include "elasticity/linear_force.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {

namespace {

int numbers_of_cell(int dimension) { return dimension * (2 + dimension); }

/// Fits a linear force to forces f at the points x of one cell, and appends its numbers.
template <int d>
void append_fit(const std::vector<mesh::Point>& x, const std::vector<mesh::Point>& f, std::vector<double>& numbers) {
  using Vector = Eigen::Matrix<double, d, 1>;
  using Matrix = Eigen::Matrix<double, d, d>;
  const auto mean = [](const std::vector<mesh::Point>& all) {
    Vector sum = Vector::Zero();
    for (const mesh::Point& p : all) sum += Eigen::Map<const Vector>(p.data());
    return Vector(sum / static_cast<double>(all.size()));
  };
  const bool alike = std::ranges::all_of(f, [&](const mesh::Point& at) { return std::equal(at.begin(), at.begin() + d, f[0].begin()); });
  const Vector middle = mean(x), force = alike ? Vector(Eigen::Map<const Vector>(f[0].data())) : mean(f);
  Matrix moments = Matrix::Zero(), products = Matrix::Zero();
  for (std::size_t q = 0; q < x.size() && !alike; ++q) {
    const Vector from = Eigen::Map<const Vector>(x[q].data()) - middle;
    moments += from * from.transpose(), products += (Eigen::Map<const Vector>(f[q].data()) - force) * from.transpose();
  }
  const Matrix gradient = alike ? Matrix(Matrix::Zero()) : Matrix(products * moments.inverse());
  numbers.insert(numbers.end(), middle.begin(), middle.end());
  numbers.insert(numbers.end(), force.begin(), force.end());
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) numbers.push_back(gradient(i, j));
}

}  // namespace

LinearForce::LinearForce(const mesh::Mesh& mesh, const VectorField& force) : dimension_(mesh.dimension()) {
  std::vector<double> numbers;
  bool uniform = true;
  mesh::Point first{0, 0, 0};
  std::vector<mesh::Point> x, f;
  for_each_cell_point(mesh, [&, points = cell_points(mesh)](const CellPoint& p) {
    x.push_back(p.x), f.push_back(force(p.x));
    if (p.cell == 0 && p.index == 0) first = f[0];
    uniform = uniform && std::equal(first.begin(), first.begin() + dimension_, f.back().begin());
    if (p.index + 1 < points) return;
    dimension_ == 2 ? append_fit<2>(x, f, numbers) : append_fit<3>(x, f, numbers);
    x.clear(), f.clear();
  });
  if (uniform) numbers.resize(static_cast<std::size_t>(numbers_of_cell(dimension_)));
  else place_.resize(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(place_.begin(), place_.end(), 0);
  numbers_ = std::make_shared<const std::vector<double>>(std::move(numbers));
}

mesh::Point LinearForce::at(int cell, const mesh::Point& x) const {
  const int d = dimension_;
  const double* middle = numbers_->data() + (varies() ? static_cast<std::size_t>(place_[cell]) * numbers_of_cell(d) : 0);
  const double *force = middle + d, *gradient = force + d;
  mesh::Point f{0, 0, 0};
  for (int i = 0; i < d; ++i) {
    f[i] = force[i];
    for (int j = 0; j < d; ++j) f[i] += gradient[i * d + j] * (x[j] - middle[j]);
  }
  return f;
}

LinearForce LinearForce::of(const std::vector<int>& cells) const {
  LinearForce out = *this;
  if (!varies()) return out;
  out.place_.clear();
  for (const int c : cells) out.place_.push_back(place_[c]);
  return out;
}

Lists LinearForce::lists() const {
  std::vector<double> numbers;
  if (any() && !varies()) numbers = *numbers_;
  const auto size = static_cast<std::ptrdiff_t>(numbers_of_cell(dimension_));
  for (const int p : place_) numbers.insert(numbers.end(), numbers_->begin() + p * size, numbers_->begin() + (p + 1) * size);
  return {{{dimension_, varies()}}, {std::move(numbers)}};
}

LinearForce::LinearForce(const std::vector<int>& whole, std::vector<double> real) : dimension_(whole[0]) {
  if (dimension_ == 0) return;
  if (whole[1]) place_.resize(real.size() / static_cast<std::size_t>(numbers_of_cell(dimension_)));
  std::iota(place_.begin(), place_.end(), 0);
  numbers_ = std::make_shared<const std::vector<double>>(std::move(real));
}

}  // namespace dotyk::elasticity

#include "problem/problem.hpp"

#include "algebra/symmetric_matrix.hpp"
#include "algebra/congruent.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "base/moderate.hpp"

namespace dotyk::problem {

using algebra::LongVector;
using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

int Problem::all_unknowns() const {
  int all = unknowns();
  for (const Block& block : blocks) all += block.hidden;
  return all;
}

std::size_t Problem::block_of(Eigen::Index unknown) const {
  const auto next = std::upper_bound(blocks.begin(), blocks.end(), unknown, [](Eigen::Index u, const Block& block) { return u < block.first; });
  return static_cast<std::size_t>(next - blocks.begin()) - 1;
}

std::vector<ScalarRow> Problem::scalar_rows() const {
  std::vector<ScalarRow> all;
  for (const RowGroup& group : groups)
    for (int k = 0; k < group.count; ++k) all.push_back({*group.law, k, group.first + k});
  return all;
}

std::vector<FrictionPoint> Problem::friction_points() const {
  std::vector<FrictionPoint> all;
  for (const FrictionGroup& group : friction)
    for (int k = 0; k < group.points(); ++k) all.push_back({group, k, group.row(k), group.normal[k]});
  return all;
}

std::vector<const RowGroup*> Problem::group_of_rows() const {
  std::vector<const RowGroup*> of(rows());
  for (const RowGroup& group : groups)
    for (int r = group.first; r < group.first + group.count; ++r) of[r] = &group;
  return of;
}

Vector Problem::row_stiffness() const {
  Vector compliance = Vector::Zero(rows());
  for (int r = 0; r < rows(); ++r)
    for (SparseRows::InnerIterator it(B, r); it; ++it) {
      const Block& block = blocks[block_of(it.col())];
      compliance[r] += it.value() * it.value() / block.K.diagonal(static_cast<int>(it.col()) - block.first);
    }
  return compliance.unaryExpr([](double yields) { return yields > 0 ? 1 / yields : 0.0; });
}

SparseRows Problem::rows_of(const Block& block) const { return B.middleCols(block.first, block.size()); }

std::string Problem::name_of(int row) const { return row_name ? row_name(row) : text("row ", row + 1); }

Vector Problem::load() const {
  Vector f(unknowns());
  for (const Block& block : blocks) f.segment(block.first, block.size()) = block.f;
  return f;
}

bool Problem::loaded() const {
  return sliced_load != 0 || std::ranges::any_of(blocks, [](const Block& block) { return !block.f.isZero(0); });
}

Problem::NearRows Problem::near_rows() const {
  NearRows near;
  const auto each_entry = [&](const auto& visit) {
    for (int r = 0; r < B.rows(); ++r)
      for (SparseRows::InnerIterator it(B, r); it; ++it) visit(r, static_cast<int>(it.col()), it.value());
  };
  each_entry([&](int, int unknown, double) { near.unknowns.push_back(unknown); });
  std::ranges::sort(near.unknowns);
  near.unknowns.erase(std::ranges::unique(near.unknowns).begin(), near.unknowns.end());
  algebra::Triplets entries;
  each_entry([&](int r, int unknown, double value) {
    entries.emplace_back(r, static_cast<int>(std::ranges::lower_bound(near.unknowns, unknown) - near.unknowns.begin()), value);
  });
  near.B = algebra::from_triplets<SparseRows>(B.rows(), std::ssize(near.unknowns), entries);
  return near;
}

void require_kernel(const algebra::SymmetricMatrix& K, const algebra::DenseMatrix& kernel, const std::string& name,
                    const std::vector<Motion>& motions) {
  // Between rounding (a few 1e-16, flat cells, great distances and near incompressibility included) and whatever holds a body.
  constexpr double kResists = 1e-12;
  if (kernel.cols() == 0) return;
  Eigen::Index worst;
  const double most = algebra::kernel_residual(K, kernel).maxCoeff(&worst);
  if (most <= kResists) return;
  throw InputError(text(name, ": the stiffness resists ",
                        worst < static_cast<Eigen::Index>(motions.size()) ? motions[worst].text() : text("mode ", worst + 1),
                        ", which its supports leave free, by ", most,
                        " of its rows; rounding leaves 1e-16. The body is held by nodes or springs less than a "
                        "billionth of its size apart: hold it on more than that, or let it free"));
}

namespace {

constexpr double kMostStiffness = 1e120, kMostDisplacement = 1e175;

void require_within(double size, double most, const char* what) {
  if (!moderate(size, most))
    throw InputError(text("values beyond the range of numbers: ", what, " are about ", size, ", and what is beyond ", most, " or below ", 1 / most,
                          " is lost where it is squared; choose units in which stiffness, loads and sizes are moderate"));
}

}  // namespace

void require_moderate(const Problem& problem, double most_force) {
  double stiffness = 0, force = 0, gap = 0;
  const auto grow = [](double& greatest, double value) { greatest = std::isnan(value) ? INFINITY : std::max(greatest, std::abs(value)); };
  for (const Block& block : problem.blocks) {
    grow(stiffness, block.K.greatest_on_diagonal());
    for (const double f : block.f) grow(force, f);
  }
  if (problem.sliced_load != 0) grow(force, whole_load(problem).greatest());
  for (const double c : problem.c)
    if (!std::isinf(c)) grow(gap, c);
  require_within(stiffness, kMostStiffness, "stiffnesses");
  require_within(force, most_force, "loads");
  require_within(gap, kMostDisplacement, "gaps and prescribed displacements");
  grow(force, gap * stiffness);
  require_within(force, most_force, "forces");
  require_within(stiffness > 0 ? force / stiffness : 0, kMostDisplacement, "displacements");
}

void refuse_singular(const std::string& name, Eigen::Index modes, int node, const std::pair<std::string, std::string>& about) {
  throw SingularStiffness(text("the stiffness of ", name, " is singular", node >= 0 ? text(" at node ", node + 1, about.first) : "", modes > 0 ? text(" beyond its ", modes, " rigid motions") : "",
                        ": ", about.second.empty() ? "a material, spring or mesh value is out of range, or cells hang together at single nodes only" : about.second));
}

void refuse_singular(const Block& block, int unknown) {
  const int node = unknown >= 0 ? block.node[static_cast<std::size_t>(unknown)] : -1;
  refuse_singular("'" + block.name + "'", block.kernel.cols(), node, node >= 0 && block.about ? block.about(node) : std::pair<std::string, std::string>());
}

void add(Problem& problem, Block block) {
  require_kernel(block.K, block.kernel, "'" + block.name + "'", block.motions);
  block.first = problem.unknowns();
  problem.blocks.push_back(std::move(block));
}

bool prescribes(const RowGroup& group) {
  for (int k = 0; k < group.count; ++k)
    if (group.law->linear_stiffness(k) != Law::kUnbounded) return false;
  return true;
}

void take_slices(Problem& problem, const std::shared_ptr<const algebra::SlicedMatrix>& slices) {
  if (problem.blocks.size() == 1) return void(problem.blocks[0].K = slices);
  for (Block& block : problem.blocks) block.K = algebra::SymmetricMatrix(std::make_shared<const algebra::BlockOfSlices>(slices, block.first, block.size()));
}

const algebra::SlicedMatrix* slices(const Problem& problem) {
  if (problem.blocks.size() == 1) return problem.blocks[0].K.slices();
  const algebra::SlicedMatrix* all = nullptr;
  for (const Block& block : problem.blocks) {
    const auto* part = dynamic_cast<const algebra::BlockOfSlices*>(block.K.slices());
    if (!part || part->first() != block.first || (all && all != &part->whole())) return nullptr;
    all = &part->whole();
  }
  return all && all->diagonal().size() == problem.unknowns() ? all : nullptr;
}

SparseMatrix lower_stiffness(const Problem& problem) {
  if (problem.blocks.size() == 1) return problem.blocks.front().K;
  if (const auto* sliced = slices(problem); sliced && !sliced->hides()) {
    std::vector<char> all(static_cast<std::size_t>(problem.unknowns()), 1);
    algebra::StoredMatrix whole = sliced->near(all);
    SparseMatrix lower;
    lower.swap(whole);
    return lower;
  }
  std::vector<const SparseMatrix*> blocks;
  for (const Block& block : problem.blocks) blocks.push_back(&block.K.lower());
  return algebra::block_diagonal(blocks);
}

std::vector<int> nodes(const Problem& problem) {
  std::vector<int> all;
  int first = 0;
  for (const Block& block : problem.blocks) {
    for (const int n : block.node) all.push_back(first + n);
    first = all.empty() ? 0 : all.back() + 1;
  }
  return all;
}

namespace {

template <class Numbers>
Numbers times(const Problem& problem, const Numbers& u) {
  if (problem.blocks.size() == 1) return problem.blocks[0].K.times(u);
  Numbers result(problem.unknowns());
  for (const Block& block : problem.blocks)
    result.segment(block.first, block.size()) = block.K.times(Eigen::Map<const Numbers>(u.data() + block.first, block.size()));
  return result;
}

}  // namespace

std::shared_ptr<algebra::Vectors> vectors(const Problem& problem, const std::vector<int>& watched) {
  const auto* all = slices(problem);
  return all ? all->vectors(watched) : algebra::vectors_here(problem.unknowns(), watched);
}

algebra::Field whole_load(const Problem& problem, std::shared_ptr<algebra::Vectors> where) {
  algebra::Field all(where ? std::move(where) : vectors(problem));
  if (problem.loaded()) all.put(problem.load());
  if (problem.sliced_load == 0) return all;
  algebra::Field of_slices(all.where());
  slices(problem)->add_load(of_slices);
  all.add(problem.sliced_load, of_slices);
  return all;
}

std::shared_ptr<const algebra::Field> field(const Problem& problem, const Displacement& u) {
  const auto* all = slices(problem);
  if (u.there() && (!all || all->holds(*u.there()->where()))) return u.there();
  algebra::Field field(vectors(problem));
  field.put(u.here());
  return std::make_shared<const algebra::Field>(std::move(field));
}

Vector rows_times(const Problem& problem, const Displacement& u) {
  if (!u.there()) return problem.B * u.here();
  const Problem::NearRows near = problem.near_rows();
  return near.B * u.there()->some(near.unknowns);
}

algebra::Field stiffness_times(const Problem& problem, const algebra::LongField& u, bool precisely) {
  algebra::Field product(u.high.where());
  take_stiffness_times(problem, u, precisely, product);
  product.add(-2, product);  // it was taken off nothing, and −x − 2(−x) = x
  return product;
}

Vector stiffness_times(const Problem& problem, const Vector& u) {
  return stiffness_times(problem, algebra::LongField(*field(problem, u)), true).get();
}

void take_stiffness_times(const Problem& problem, const algebra::LongField& u, bool precisely, algebra::Field& from) {
  if (const auto* all = slices(problem)) return all->take_product(u, precisely, from);
  const Vector high = u.high.get();
  if (!precisely) return from.put(from.get() - times(problem, high));
  const LongVector product = times(problem, LongVector(high.cast<long double>() + u.low.get().cast<long double>()));
  from.put((from.get().cast<long double>() - product).cast<double>());
}

}  // namespace dotyk::problem

#include "algebra/field.hpp"

namespace dotyk::algebra {

namespace {

class VectorsHere final : public Vectors {
 public:
  VectorsHere(int unknowns, std::vector<int> watched) : Vectors(unknowns, std::move(watched)), all_(unknowns, true) {}
  double run(const VectorOrder& order) override { return all_.run(order); }
  Vector get(int v) override { return vector(all_[v]); }
  void put(int v, const Vector& numbers) override { all_[v].assign(numbers.begin(), numbers.end()); }
  Vector some(int v, const std::vector<int>& unknowns) override { return vector(all_.some(v, unknowns)); }
  void set_some(int v, const std::vector<int>& unknowns, const Vector& numbers) override { all_.set_some(v, unknowns, {numbers.begin(), numbers.end()}); }

 private:
  static Vector vector(const std::vector<double>& numbers) { return Eigen::Map<const Vector>(numbers.data(), std::ssize(numbers)); }

  VectorParts all_;
};

}  // namespace

std::shared_ptr<Vectors> vectors_here(int unknowns, std::vector<int> watched) { return std::make_shared<VectorsHere>(unknowns, std::move(watched)); }

}  // namespace dotyk::algebra

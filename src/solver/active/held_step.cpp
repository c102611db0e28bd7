#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra/krylov/conjugate_residuals.hpp"
#include "base/text.hpp"
#include "solver/active/held_stiffness.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {
namespace {

using algebra::Field;
using algebra::SparseRows;
using algebra::Vector;
using algebra::LongVector;
using problem::Problem;

/// Spring of a rigid row that holds no unknown, in units of the stiffness that it sees: most of its force then comes with the first solution, while rounding
/// of displacements, times the spring, stays small in it.
constexpr double kHeldRowSpring = 100;
/// Of a point that hardly slips the stiffness across its slip, b/‖x‖, grows without bound. More than so many times the stiffness that the point sees is of
/// no use: the solution, where nothing moves across the slip, is the same, and errors still fall by about this factor a step.
constexpr double kMostAcross = 1e4;
constexpr int kMostSteps = 60, kMostRounds = 3;
/// How far tied rows may be off, of the displacements that make them up, and what the steps of a round aim at.
constexpr double kOff = 1e-12, kAim = 1e-15;
/// What refinement aims at: forces left on unknowns that are not held, relative to the loads and multipliers. Direct solvers go to kUnbalanced at once.
/// Iterative ones do not, since digits cost iterations. Without friction, steps go to kRough until the active set comes to rest, then to kSharper. With friction,
/// steps converge as Newton's method does: each goes to kOfOff times the last violation of the laws, relative to the forces of the rows, but is never
/// rougher than kSharper: more steps were needed otherwise where stiffnesses differ by a factor of 100. The last steps, with friction or without, go to
/// kOfTolerance times the tolerance of the method.
constexpr double kUnbalanced = 1e-12, kOfTolerance = 0.01, kSharper = 1e-3, kRough = 0.03, kOfOff = 0.01;
constexpr int kMostRefinements = 6;        ///< of one step
constexpr double kShare = 0.3;             ///< of what refinement aims at, what one goes to
constexpr double kRounding = 1e-6;         ///< above this tolerance residuals are computed in double precision
constexpr double kShareOfDirection = 0.1;  ///< how exactly directions of conjugate residuals are solved for

/// Vectors of all unknowns lie where K does. Beside them this process has what is near rows, see HeldStiffness::near_rows(): there multipliers act, unknowns are held,
/// and u' differs from u. Vectors called near have these unknowns alone.
class HeldStep final : public Step {
 public:
  HeldStep(const Problem& problem, HeldStiffness& stiffness, const Vector& rho, double tol)
      : problem_(problem), stiffness_(stiffness), rho_(rho), least_(std::max(kUnbalanced, stiffness.solver().iterates() ? kOfTolerance * tol : 0)), own_(problem.row_stiffness()),
        basis_(stiffness.basis()), T_(stiffness.near_basis().T.cast<long double>()), f_(stiffness.load()), u_(stiffness.field()), before_(u_),
        near_u_(LongVector::Zero(std::ssize(stiffness.near_rows()))), near_before_(near_u_), elsewhere_(stiffness.field()) {
    of_loads_ = f_.moduli();
    for (const problem::FrictionGroup& group : problem.friction)
      for (int r = group.first; r < group.row(group.points()); ++r)
        if (basis_.unknown[r] < 0)
          throw NotSolved(text("pdas on all unknowns, which multigrid uses, cannot treat the ", group.law->name(), " of the ", group.name, " at ",
                               problem.name_of(r), ": other rows have taken the unknowns there, as at corners; newton can"));
  }

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    before_ = u_, near_before_ = near_u_;
    sort(l);
    place(l.slips);
    if (!stiffness_.factor(spring_, held_, across_)) return false;
    lambda_ = constant_, known_ = false;
    const double enough = (problem_.friction.empty() ? kRough : kOfOff * l.off) * of_rows_;
    unbalanced_ = stiffness_.solver().iterates() && tied_.empty() ? std::clamp(enough, least_, roughest_) : least_;
    if (slips_.empty())
      if (const double sum = left(); sum != 0) approach(sum);
    refine();
    return finite_ && tie() && tell(lambda, x);
  }

  void begin(const problem::Displacement& u) override {
    u_ = algebra::LongField(stiffness_.noticed(u));
    near_u_ = u_.high.watched().cast<long double>();
    finite_ = std::isfinite(u_.high.moduli());
    forget();
  }

  bool sharpen(Vector& lambda, Vector& x) override {
    if (unbalanced_ <= least_) return false;
    roughest_ = unbalanced_ = unbalanced_ > kSharper ? std::max(kSharper, least_) : least_, known_ = false;
    refine();
    return finite_ && tell(lambda, x);
  }
  void go_back(double part) override {
    if (part == 0) u_ = before_, near_u_ = near_before_;  // what was added may be no number
    else u_.go_back(before_, part), near_u_ = near_before_ + static_cast<long double>(part) * (near_u_ - near_before_);
    finite_ = std::isfinite(u_.high.moduli());
    forget();
  }
  problem::Displacement recover() override { return problem::Displacement(u_.high); }

 private:
  /// How exact elastic forces are: a product in double precision, or one in extended precision that is rounded to double at the end.
  enum class Known { no, roughly, precisely };

  void add(double factor, const Field& by, const Vector& near) {
    u_.add(factor, by), near_u_ += static_cast<long double>(factor) * near.cast<long double>();
    finite_ = finite_ && near_u_.allFinite();
  }
  void add(double factor, const HeldStiffness::Displaced& by) {
    finite_ = finite_ && by.found;
    add(factor, by.u, by.near_u);
  }
  void forget() { known_ = false, elastic_known_ = Known::no; }
  /// The resistance is rounded as a product in double precision. Where the movement is at most a hundredth of u, this error is a hundredth of that of Ku, and
  /// elastic forces still count as precise. Elsewhere they become what the iterations say is left, which is as exact. Where springs hold rows that have no unknown of their own they do not: there great terms cancel.
  void move(HeldStiffness::Displaced by) {
    constexpr double kSmall = 0.01;
    if (elastic_known_ == Known::precisely && by.found && by.told && (sprung_ || !(by.u.greatest() <= kSmall * u_.high.greatest()))) elastic_known_ = Known::roughly;
    add(1, by);
    if (!by.told) return forget();
    known_ = false;
    elsewhere_.swap(by.left), near_elastic_ -= by.near_resistance;
  }

  /// Solves for the forces that are left. Of them may remain kShare of what refinement aims at, and at most kShare of themselves. `sum`: left().
  void approach(double sum) {
    const double aim = std::min(1.0, unbalanced_ * gross_ / sum);
    const Known known = elastic_known_;
    HeldStiffness::Displaced by = displaced(std::max(HeldStiffness::kTolerance, kShare * aim));
    elastic_known_ = known;
    move(std::move(by));
  }
  /// By the forces that are left, which are not known afterwards: elsewhere_ then has numbers near rows.
  HeldStiffness::Displaced displaced(double tolerance = HeldStiffness::kTolerance) {
    const Vector& near = forces();
    elastic_known_ = Known::no;
    return stiffness_.solve_in_basis(elsewhere_, near, tolerance);
  }
  /// ‖·‖₁ of the forces that are left where u is not held.
  double left() {
    const Vector& near = forces();
    double sum = elsewhere_.moduli();
    for (Eigen::Index k = 0; k < near.size(); ++k)
      if (!held_[stiffness_.near_rows()[k]]) sum += std::abs(near[k]);
    return sum;
  }

  /// What each row does, and u where it is held; elsewhere iterations go on from the last one.
  void sort(const Linearisation& l) {
    constant_ = spring_ = target_ = Vector::Zero(problem_.rows());
    held_.assign(problem_.unknowns(), 0);
    if (!stiffness_.solver().iterates() || !finite_) u_ = algebra::LongField(stiffness_.field()), near_u_.setZero(), finite_ = true, forget();
    Vector moved = Vector::Zero(near_u_.size());
    holding_.clear(), tied_.clear(), sprung_ = false;
    for (int r = 0; r < problem_.rows(); ++r) {
      if (!l.active[r]) {
        constant_[r] = l.value[r];
        continue;
      }
      target_[r] = problem_.c[r] + l.offset(r, rho_[r]);
      const double compliance = l.added_compliance(r, rho_[r]);
      if (compliance > 0) {
        spring_[r] = 1 / compliance;
        sprung_ = sprung_ || basis_.unknown[r] < 0;
        continue;
      }
      if (const int own = basis_.unknown[r]; own >= 0) {
        held_[own] = 1;
        moved[stiffness_.place(own)] = -static_cast<double>(gap(r));
        holding_.push_back({r, stiffness_.place(own)});
      } else {
        tied_.push_back(r);
        spring_[r] = kHeldRowSpring * own_[r], sprung_ = true;
      }
    }
    known_ = false;
    if (moved.isZero(0)) return;
    if (basis_.of_signs()) near_u_ += stiffness_.near_basis().displacements(moved).cast<long double>();
    else near_u_ += T_ * moved.cast<long double>();
    const Vector high = near_u_.cast<double>();
    u_.high.set_watched(high), u_.low.set_watched((near_u_ - high.cast<long double>()).cast<double>());
    if (elastic_known_ == Known::no) return;
    elastic_known_ = Known::roughly;
    near_elastic_ -= stiffness_.resistance_of_watched(moved);
  }

  /// Stiffness across the direction of slip.
  void place(const std::vector<Linearisation::Slip>& slips) {
    slips_ = slips, across_.clear();
    for (Linearisation::Slip& s : slips_) {
      s.across = std::min(s.across, kMostAcross * own_[s.row]);
      target_.segment(s.row, s.components) = problem_.c.segment(s.row, s.components);
      s.add_stiffness(basis_.unknown, across_);
    }
  }

  int place_of(int row) const { return stiffness_.place(basis_.unknown[row]); }

  /// What the force of a slipping point has beyond P(y), the forces `left` near rows given as without it.
  Vector beyond(const Linearisation::Slip& s, const Vector& left) const {
    Vector slip(s.components);
    for (int i = 0; i < s.components; ++i) slip[i] = static_cast<double>(gap(s.row + i));
    return s.beyond(slip, s.by_normal > 0 ? multiplier(s.normal, left) - s.pressed : 0);
  }

  double multiplier(int row, const Vector& left) const {  // of a scalar row
    const int own = basis_.unknown[row];
    return own >= 0 && held_[own] ? left[place_of(row)] : static_cast<double>(lambda_[row] + spring_[row] * gap(row));
  }

  /// Where cells are small beside the body, as with thousands of supports of a beam, one solution leaves forces that are no rounding of the loads.
  void refine() {
    if (!slips_.empty()) return refine_slipping();
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMostRefinements && finite_; ++k) {
      const double sum = left();
      if (!(sum > unbalanced_ * gross_) || sum > before / 2) return;
      before = sum;
      approach(sum);
    }
  }

  /// Where bounds follow the pressure the equations are not symmetric; the preconditioner is the matrix with bounds as they are.
  void refine_slipping() {
    algebra::conjugate_residuals(
        [&](const std::optional<Field>& by) -> algebra::Remainder {
          if (by) add(1, *by, by->watched()), forget();
          return {residual(), unbalanced_ * gross_};
        },
        [&](Field& left) -> algebra::ResidualDirection {
          HeldStiffness::Displaced by = stiffness_.solve_in_basis(left, left.watched(), kShareOfDirection);
          Field change = response(left, by);
          return {std::move(by.u), std::move(change)};
        });
  }

  /// f − Ku − Bᵀλ with the springs' multipliers as they are, zero where u is held.
  Field residual() {
    Vector near = forces();
    for (const Holding& h : holding_) near[h.place] = 0;
    Field left = elsewhere_;
    left.set_watched(near);
    return left;
  }

  /// What residual() loses where u grows by that, the displacement under the forces `given`.
  Field response(const Field& given, const HeldStiffness::Displaced& by) const {
    Field lost = stiffness_.field();
    Vector near = by.near_resistance;
    if (by.told) lost = given, lost.add(-1, by.left);
    else {
      lost = problem::stiffness_times(problem_, algebra::LongField(by.u), false);
      near = stiffness_.near_basis().forces(lost.watched());
    }
    const Vector moved = stiffness_.jumps() * by.near_u;
    near += stiffness_.rows().transpose() * spring_.cwiseProduct(moved);
    const Vector before = near;
    for (const Linearisation::Slip& s : slips_) {
      const bool holds = s.by_normal > 0 && basis_.unknown[s.normal] >= 0 && held_[basis_.unknown[s.normal]];
      const double pressed = s.by_normal > 0 ? (holds ? -before[place_of(s.normal)] : spring_[s.normal] * moved[s.normal]) : 0;
      const Vector force = s.beyond(moved.segment(s.row, s.components), pressed);
      for (int i = 0; i < s.components; ++i) near[place_of(s.row + i)] += force[i];
    }
    for (const Holding& h : holding_) near[h.place] = 0;
    lost.set_watched(near);
    return lost;
  }

  /// f − Ku − Bᵀλ near rows, in the basis where rows are unknowns. Elsewhere they are elastic forces alone.
  const Vector& forces() {
    if (std::exchange(known_, true)) return forces_;
    know_elastic(unbalanced_ < kRounding ? Known::precisely : Known::roughly);
    Vector& left = forces_;
    left = near_elastic_, gross_ = of_loads_;
    for (int r = 0; r < problem_.rows(); ++r) {
      const long double multiplier = lambda_[r] + spring_[r] * gap(r);
      if (multiplier == 0) continue;
      for (SparseRows::InnerIterator it(stiffness_.rows(), r); it; ++it) left[it.col()] -= static_cast<double>(it.value() * multiplier);
      gross_ += problem_.B.row(r).cwiseAbs().sum() * static_cast<double>(std::abs(multiplier));
    }
    const Vector without = slips_.empty() ? Vector() : left;
    for (const Linearisation::Slip& s : slips_) {
      const Vector force = beyond(s, without);
      for (int i = 0; i < s.components; ++i) left[place_of(s.row + i)] -= force[i];
    }
    for (const Holding& h : holding_) gross_ += std::abs(left[h.place]);
    of_rows_ = gross_ > 0 ? (gross_ - of_loads_) / gross_ : 1;
    return left;
  }

  /// Computes elastic forces by a product, unless they are known as exactly already.
  void know_elastic(Known how) {
    if (elastic_known_ >= how) return;
    elastic_known_ = Known::no;
    elsewhere_ = f_;
    problem::take_stiffness_times(problem_, u_, how == Known::precisely, elsewhere_);
    near_elastic_ = stiffness_.near_basis().forces(elsewhere_.watched());
    elsewhere_.set_watched(Vector::Zero(near_elastic_.size()));
    elastic_known_ = how;
  }

  /// Bu − t of a row.
  long double gap(int row) const {
    long double sum = -target_[row];
    for (SparseRows::InnerIterator it(stiffness_.jumps(), row); it; ++it) sum += it.value() * near_u_[it.col()];
    return sum;
  }

  /// λ of tied rows so that Bu = t there. False where they contradict each other.
  bool tie() {
    for (int round = 0; round < kMostRounds && off(tied_gap()) > kAim && finite_; ++round) {
      approach_ties();
      add(1, displaced()), forget();
    }
    return off(tied_gap()) <= kOff;
  }

  /// Conjugate gradients on B(K + sBᵀB)⁻¹Bᵀ δλ = Bu − t, preconditioned by s, which makes the first step one of the method of multipliers.
  void approach_ties() {
    Vector gap = tied_gap(), p = spring_.cwiseProduct(gap);
    double energy = gap.dot(p);
    for (int k = 0; k < kMostSteps && off(gap) > kAim; ++k) {
      Field nothing = stiffness_.field();
      const HeldStiffness::Displaced moved = stiffness_.solve_in_basis(nothing, stiffness_.rows().transpose() * p);
      Vector q = Vector::Zero(p.size());
      q(tied_) = Vector(stiffness_.jumps() * moved.near_u)(tied_);
      const double curvature = p.dot(q), t = energy / curvature;
      if (!(moved.found && curvature > 0)) return;
      lambda_ += t * p, gap -= t * q;
      add(-t, moved), forget();
      const Vector z = spring_.cwiseProduct(gap);
      const double before = std::exchange(energy, gap.dot(z));
      p = z + energy / before * p;
    }
  }

  Vector tied_gap() const {
    Vector out = Vector::Zero(problem_.rows());
    for (const int r : tied_) out[r] = static_cast<double>(gap(r));
    return out;
  }

  /// The greatest gap of a tied row against the displacements in it.
  double off(const Vector& gap) const {
    if (!gap.allFinite()) return INFINITY;
    const double size = tied_.empty() ? 0 : u_.high.greatest();
    double worst = 0;
    for (const int r : tied_)
      if (gap[r] != 0) worst = std::max(worst, std::abs(gap[r]) / (problem_.B.row(r).cwiseAbs().sum() * size + std::abs(target_[r])));
    return worst;
  }

  /// λ and x: multipliers of springs, and of rows that hold by equilibrium.
  bool tell(Vector& lambda, Vector& x) {
    lambda = lambda_;
    for (int r = 0; r < problem_.rows(); ++r)
      if (spring_[r] != 0) lambda[r] += static_cast<double>(spring_[r] * gap(r));
    const Vector& left = forces();
    for (const Holding& h : holding_) lambda[h.row] = left[h.place];
    for (const Linearisation::Slip& s : slips_) lambda.segment(s.row, s.components) += beyond(s, left);
    x.resize(problem_.rows());
    for (int r = 0; r < problem_.rows(); ++r) x[r] = static_cast<double>(gap(r) + target_[r] - static_cast<long double>(problem_.c[r]));
    return lambda.allFinite();
  }

  /// A row, and the place of its unknown among those near rows.
  struct Holding {
    int row, place;
  };

  const Problem& problem_;
  HeldStiffness& stiffness_;
  const Vector& rho_;
  const double least_;   ///< the least value that unbalanced_ may take
  const Vector own_;
  using LongMatrix = Eigen::SparseMatrix<long double>;
  const problem::RowBasis& basis_;
  const LongMatrix T_;   ///< its T near rows; empty where that is
  Field f_;
  double of_loads_;      ///< ‖f‖₁
  Vector constant_, spring_, target_;  ///< rows: λ of those that are not active; s and t of λ = s(Bu − t), and Bu of rigid ones
  std::vector<char> held_;
  std::vector<Holding> holding_;
  std::vector<Linearisation::Slip> slips_;
  algebra::Triplets across_;
  std::vector<int> tied_;              ///< rigid rows that hold no unknown
  bool sprung_ = false;                ///< do springs hold rows that have no unknown of their own?
  algebra::LongField u_, before_;      ///< of more digits than the factor's solutions have: see stiffness_times()
  LongVector near_u_, near_before_;    ///< the same near rows
  bool finite_ = true;                 ///< is u_?
  Vector lambda_;
  Field elsewhere_;                    ///< Tᵀ(f − Ku) at all unknowns that are not near rows, zero near them; meaningless where elastic_known_ is `no`
  Vector near_elastic_;                ///< the same near rows
  Known elastic_known_ = Known::no;
  Vector forces_;                      ///< near rows
  bool known_ = false;                 ///< are forces_ those of u_ and lambda_?
  double unbalanced_ = least_;         ///< of gross_, what is aimed at
  double roughest_ = problem_.friction.empty() ? kRough : kSharper;  ///< the greatest value that unbalanced_ may take
  double gross_ = 0;                   ///< ‖f‖₁ + ‖Bᵀλ‖₁ of the last forces()
  double of_rows_ = 1;                 ///< the second's share: small where supports are moved, as their forces are loads
};

}  // namespace

std::unique_ptr<Step> held_step(const Problem& problem, HeldStiffness& stiffness, const Vector& rho, double tol) {
  return std::make_unique<HeldStep>(problem, stiffness, rho, tol);
}

}  // namespace dotyk::solver

#include "thermoelastic/stepping.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dotyk::thermoelastic {

using algebra::Vector;

namespace {

/// Diagonally implicit: stage i is at c_i τ. The last stage is the step's end: its row, with the diagonal, weighs the stages.
struct Tableau {
  double diagonal;                     ///< of the implicit stages
  std::vector<std::vector<double>> a;  ///< below the diagonal
  std::vector<double> c;
  bool continues = false;  ///< the first stage is the end of the last step
};

const Tableau& tableau(Order order, bool first_step) {
  static const double gamma = 1 - std::sqrt(0.5), w = std::sqrt(2.0) / 4;
  static const Tableau euler{1, {{}}, {1}}, alexander{gamma, {{}, {1 - gamma}}, {gamma, 1}},
      tr_bdf2{gamma, {{}, {gamma}, {w, w}}, {0, 2 * gamma, 1}, true};
  return order == Order::one ? euler : first_step ? alexander : tr_bdf2;
}

const char* name(Effect::Kind kind) { return kind == Effect::Kind::bending ? "bending" : "stretching"; }

/// Steps whose lengths differ by less share a factor.
constexpr double kSameStep = 1e-10;

void require_finite(const Fields& fields, double energies, double t) {
  if (fields.u.allFinite() && fields.theta.allFinite() && std::isfinite(energies)) return;
  throw InputError(text("at t = ", t, " values are beyond the range of numbers; choose units in which loads, stiffnesses and temperatures are moderate"));
}

}  // namespace

double Stepping::Group::stored(const Fields& fields, const Forces& loads) const {
  double sum = 0.5 * fields.u.dot(model->K * fields.u) + 0.5 * fields.theta.dot(model->capacity * fields.theta);
  for (const Part& part : model->parts)
    for (const Held& held : part.held)
      sum += problem::row_law(std::array{problem::LawRow{held.law}}, held.unit)->energy(0, held.given(loads.supports) - held.turn * fields.u[held.unknown]);
  return sum;
}

double Stepping::Group::work_of_places(const Fields& to, const Forces& loads, bool trapezoidal) const {
  double sum = 0;
  for (std::size_t p = 0; p < model->parts.size(); ++p)
    for (std::size_t i = 0; i < model->parts[p].held.size(); ++i) {
      const Held& held = model->parts[p].held[i];
      const int k = static_cast<int>(i);
      const double force = trapezoidal ? 0.5 * (now.reactions[p][k] + to.reactions[p][k]) : to.reactions[p][k];
      sum += force * held.unit * (held.place(loads.supports) - held.place(forces.supports));
    }
  return sum;
}

Stepping::Stepping(const Data& data, const Initial& initial, const Scheme& scheme, const Loads& loads, Monitor& monitor)
    : scheme_(scheme) {
  require_valid(data);
  if (!(scheme.step > 0) || !std::isfinite(scheme.step))
    throw InputError(text("its step is ", scheme.step, "; it must be positive"));
  using Kind = Effect::Kind;
  const bool split = data.exchange_above == data.exchange_below;
  const auto kinds = split ? std::vector<std::vector<Kind>>{{Kind::stretching}, {Kind::bending}}
                           : std::vector<std::vector<Kind>>{{Kind::stretching, Kind::bending}};
  for (const auto& effects : kinds) {
    Group& group = groups_.emplace_back();
    group.take({data, effects}, scheme.decompose);
    group.forces = group.model->forces(loads, 0);
    const Vector theta = group.model->initial(initial);
    const auto rest = [&] { group.now = at_rest(*group.model, group.forces, theta, 0, scheme_.method, work_, monitor); };
    rest();
    while (group.overload(group.now.reactions) > kBears) {
      for (const std::string& name : group.break_worst(scheme.decompose)) broken_.push_back({name, 0});
      telling(0, rest);
    }
    group.entropy = group.model->entropy(group.now.u, group.now.theta);
    const double stored = group.stored(group.now, group.forces);
    require_finite(group.now, stored, 0);
    at_first_ += stored;
  }
}

void Stepping::run(double t, const Loads& loads, Monitor& monitor) {
  if (!(t >= time_) || !std::isfinite(t)) throw InputError(text("run to the time ", t, "; it is at ", time_, " now"));
  const double count = std::ceil((t - time_) / scheme_.step - 1e-9);
  if (!(count < 1e9)) throw InputError(text("", count, " steps of ", scheme_.step, " to the time ", t));
  if (count <= 0) return;
  const double from = time_, tau = (t - from) / count;
  for (int i = 1; i <= static_cast<int>(count); ++i) {
    monitor.check();
    advance(tau, loads, monitor);
    time_ = i == static_cast<int>(count) ? t : from + i * tau;
    monitor.phase(text("step ", i, " of ", static_cast<int>(count), ", t = ", time_));
  }
}

void Stepping::advance(double tau, const Loads& loads, Monitor& monitor) {
  Work work = work_;
  std::vector<Stage> ends = trial(tau, loads, work, monitor);
  if (overload(ends) <= kBears) return accept(std::move(ends), tau, work);
  Stepping later(*this);
  later.break_within(tau, loads, monitor);
  *this = std::move(later);
}

std::vector<Stepping::Stage> Stepping::trial(double tau, const Loads& loads, Work& work, Monitor& monitor) {
  std::vector<Stage> ends;
  for (Group& group : groups_) ends.push_back(stepped(group, tau, loads, work, monitor));
  return ends;
}

void Stepping::accept(std::vector<Stage> ends, double tau, const Work& work) {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    groups_[i].now = std::move(ends[i].fields);
    groups_[i].forces = std::move(ends[i].forces);
    groups_[i].entropy = std::move(ends[i].entropy);
    groups_[i].rates = std::move(ends[i].rates);
    energy_.put_in += ends[i].put_in;
    energy_.dissipated += ends[i].dissipated;
  }
  work_ = work;
  time_ += tau;
  ++steps_;
}

Stepping::Stage Stepping::stepped(Group& group, double tau, const Loads& loads, Work& work, Monitor& monitor) {
  const Tableau& scheme = tableau(scheme_.order, !group.rates);
  const Model& model = *group.model;
  const double part = scheme.diagonal * tau;
  Stage out;
  std::vector<Rates> stages;
  if (scheme.continues) stages.push_back(*group.rates);
  for (std::size_t i = stages.size(); i < scheme.c.size(); ++i) {
    const double t = time_ + scheme.c[i] * tau;
    out.forces = model.forces(loads, t);
    Vector base = group.entropy;
    for (std::size_t j = 0; j < i; ++j) base += tau * scheme.a[i][j] * stages[j].entropy;
    const bool last = i + 1 == scheme.c.size();
    out.fields = solve(group, out.forces, base + part * out.forces.r, t, part, last || !model.held_heat.empty(), work, monitor);
    const Vector& theta = out.fields.theta;
    const Vector loss = model.conduction * theta;
    Rates rates{out.forces.r - loss};  // by the heat equation, which does not hold where a temperature is
    out.entropy = base + part * rates.entropy;
    if (last && !model.held_heat.empty()) {
      const Vector entropy = model.entropy(out.fields.u, theta);
      for (const HeldTemperature& held : model.held_heat) out.entropy[held.unknown] = entropy[held.unknown];
    }
    rates.dissipated = theta.dot(loss);
    rates.supplied = out.forces.r.dot(theta);
    for (const HeldTemperature& held : model.held_heat) rates.supplied -= rates.entropy[held.unknown] * theta[held.unknown];
    stages.push_back(std::move(rates));
  }
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const double weight = tau * (i + 1 < stages.size() ? scheme.a.back()[i] : scheme.diagonal);
    out.dissipated += weight * stages[i].dissipated;
    out.put_in += weight * stages[i].supplied;
  }
  for (const HeldTemperature& held : model.held_heat) {  // what flows in there keeps the temperature
    const double before = group.now.theta[held.unknown], after = out.fields.theta[held.unknown];
    out.put_in += (out.entropy - group.entropy)[held.unknown] * (scheme_.order == Order::one ? after : 0.5 * (before + after));
  }
  const Vector moved = out.fields.u - group.now.u;
  out.put_in += scheme_.order == Order::one ? out.forces.f.dot(moved) : 0.5 * (group.forces.f + out.forces.f).dot(moved);
  out.put_in += group.work_of_places(out.fields, out.forces, scheme_.order == Order::two);
  out.rates = std::move(stages.back());
  require_finite(out.fields, out.put_in + out.dissipated + group.stored(out.fields, out.forces), time_ + tau);
  return out;
}

Fields Stepping::solve(Group& group, const Forces& forces, const Vector& b, double t, double tau, bool displaced, Work& work,
                       Monitor& monitor) {
  const auto of = [&](std::shared_ptr<System>& system, const std::vector<char>& decomposed) -> System& {
    if (!system || std::abs(system->tau() - tau) > kSameStep * tau) system = std::make_shared<System>(*group.model, decomposed, tau);
    return *system;
  };
  if (auto fields = of(group.system, group.decomposed).solve(forces, b, t, displaced, scheme_.method, work, monitor))
    return *std::move(fields);
  group.always_decomposed = false;
  return *of(group.whole, std::vector<char>(group.decomposed.size(), false))
              .solve(forces, b, t, displaced, scheme_.method, work, monitor);
}

const Data& Stepping::data() const { return groups_.front().model->data; }

std::vector<std::string> Stepping::decomposed() const {
  std::vector<std::string> out;
  for (const auto& group : groups_)
    for (std::size_t p = 0; p < group.decomposed.size(); ++p)
      if (group.decomposed[p] && group.always_decomposed) out.push_back(name(group.model->parts[p].effect.kind()));
  return out;
}

Energy Stepping::energy() const {
  Energy out = energy_;
  for (const auto& group : groups_) out.stored += group.stored(group.now, group.forces);
  out.defect = out.stored + out.dissipated + out.released - out.put_in - at_first_;
  return out;
}

}  // namespace dotyk::thermoelastic

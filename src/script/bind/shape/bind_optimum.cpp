// shape:optimise and what it returns.
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "base/whole_file.hpp"
#include "script/bind/bind.hpp"
#include "script/bind/shape/bind_shape.hpp"
#include "script/prompt/interrupt.hpp"

namespace dotyk::script {

struct OptimumHandle {
  shape::Optimum optimum;
  shape::EvaluatorCost cost;
  std::vector<std::string> refusals;  // of each design of the history
  std::shared_ptr<Design> design;  // the best one
  std::size_t method = 0;
};
template <> struct Wrapped<OptimumHandle> : Called<"optimum"> {};

namespace {

using algebra::Vector;
using shape::DesignRecord;
using shape::Optimum;

const std::vector<std::string> kOptimisers = {"slp", "mma", "ccsaq", "slsqp"};

Record design_record(const DesignRecord& d, const std::string& refusal) {
  const auto where = [](bool known, const auto& value) { return known ? std::optional(value) : std::nullopt; };
  return {"design record",
          {{"design", d.design}, {"alpha", list(d.alpha)}, {"admissible", d.admissible}, {"accepted", d.accepted}, {"radius", d.radius}, {"seconds", d.seconds},
           {"objective", where(d.admissible, d.objective)}, {"constraints", where(d.admissible, list(d.constraints))},
           {"reason", where(!d.admissible, refusal)}, {"gap", where(d.accepted, d.gap)}}};
}

/// "images/shape_%03d.png" → "images/shape_012.png".
std::string file_of(const std::string& pattern, int number) {
  const auto at = pattern.find('%');
  const auto end = pattern.find('d', at);
  const std::string digits = at == std::string::npos || end == std::string::npos ? "-" : pattern.substr(at + 1, end - at - 1);
  if (digits.size() > 2 || digits.find_first_not_of("0123456789") != std::string::npos || pattern.find('%', end) != std::string::npos)
    throw InputError(text("'figures' is \"", pattern, "\"; it must hold one place for the number of the design, as images/shape_%03d.png does"));
  char number_text[32];
  std::snprintf(number_text, sizeof number_text, digits.empty() || digits[0] != '0' ? "%*d" : "%0*d", digits.empty() ? 1 : std::stoi(digits), number);
  return pattern.substr(0, at) + number_text + pattern.substr(end + 1);
}

/// solution:render{ file = file }.
void draw(lua_State* L, const std::shared_ptr<const scene::Solution>& solution, const std::string& file) {
  luaL_checkstack(L, 8, nullptr);
  push(L, solution);
  lua_getfield(L, -1, "render");
  lua_insert(L, -2);
  lua_createtable(L, 0, 1);
  set_field(L, "file", file);
  if (lua_pcall(L, 2, 0, 0) == LUA_OK) return;
  if (interrupted()) throw Interrupted();
  lua_error(L);
}

/// One run: what each design is told to.
class Run {
 public:
  Run(Call& call, std::shared_ptr<Shape> shape, Watch& watch)
      : call_(call), shape_(std::move(shape)), watch_(watch), sought_(sought(call, *shape_)),
        evaluator_(shape_->space, shape_->method, sought_.objective, sought_.constraints, shape_->step, watch),
        start_(list(shape_->start)), radius_(call.number("radius")), method_(call.choice("method")) {
    if (call.holds<OptimumHandle>("start")) {
      const auto before = call.object<OptimumHandle>("start");
      start_ = list(before->optimum.alpha);
      if (!call.has("radius") && before->optimum.radius > 0) radius_ = before->optimum.radius;
      if (!call.has("method")) method_ = before->method;
    } else if (call.has("start")) {
      start_ = call.vector("start");
    }
    if (call.has("figures")) file_of(call.text("figures"), 1);
    if (call.has("on_design")) on_design_.push_back(call.function("on_design"));
  }

  std::shared_ptr<OptimumHandle> run() {
    const Vector start = variables_of(start_, *shape_->space, "start");
    const shape::DesignProblem problem{shape_->lower, shape_->upper, [this](const Vector& alpha) { return evaluated(alpha); },
                                       [this](const DesignRecord& record) { tell(record); }};
    auto handle = std::make_shared<OptimumHandle>();
    if (method_ == 0) {
      auto slp = settings<shape::Slp>();
      slp.radius = radius_;
      handle->optimum = minimise(problem, start, slp, stopping_);
    } else {
      auto mma = settings<shape::Mma>();
      mma.method = static_cast<shape::Mma::Method>(method_ - 1);
      handle->optimum = minimise(problem, start, mma, stopping_);
    }
    handle->refusals = refusals_;
    handle->method = method_;
    handle->cost = evaluator_.cost();
    handle->design = std::make_shared<Design>(best_, *shape_);
    return handle;
  }

 private:
  /// Stops where the user or on_design wants it.
  struct Stopping final : Monitor {
    explicit Stopping(Run& of) : run(of) {}
    bool stop() override { return run.refused_ || run.watch_.stop(); }
    Run& run;
  };

  template <class Method>
  Method settings() const {
    Method all;
    call_.fill<shape::Stopping>(all);
    return all;
  }

  std::optional<shape::Evaluation> evaluated(const Vector& alpha) {
    auto evaluation = evaluator_(alpha);
    if (!evaluation && !evaluator_.last()) throw InputError("the first design is not admissible: " + evaluator_.refusal());
    return evaluation;
  }

  void tell(const DesignRecord& record) {
    watch_.phase(record.admissible ? text("design ", record.design, ": ", sought_.objective->name(), " ", record.objective, record.radius > 0 ? text(", radius ", record.radius) : "", record.accepted ? text(", gap ", record.gap) : ", not taken")
                                   : text("design ", record.design, " is not admissible: ", evaluator_.refusal()));
    refusals_.push_back(evaluator_.refusal());
    if (record.accepted) best_ = evaluator_.last();
    if (record.accepted && call_.has("file")) save(record);
    if (record.admissible && call_.has("figures")) draw(call_.state(), evaluator_.last()->solution(), file_of(call_.text("figures"), record.design));
    if (on_design_.empty()) return;
    const Record told = design_record(record, evaluator_.refusal());
    const bool goes_on = record.admissible ? on_design_.front()(record.design, told, std::make_shared<Design>(evaluator_.last(), *shape_)) : on_design_.front()(record.design, told);
    refused_ = refused_ || !goes_on;
  }

  void save(const DesignRecord& record) const {
    std::ostringstream out;
    out << std::setprecision(17) << "-- design " << record.design << "; shape:optimise(dofile(this file)) goes on\nreturn { method = \"" << kOptimisers[method_];
    for (Eigen::Index i = 0; i < record.alpha.size(); ++i) out << (i == 0 ? "\", start = { " : ", ") << record.alpha[i];
    out << " }";
    if (record.radius > 0) out << ", radius = " << record.radius;
    write_whole_file(call_.text("file"), out.str() + " }\n");
  }

  Call& call_;
  std::shared_ptr<Shape> shape_;
  Watch& watch_;
  Sought sought_;
  shape::Evaluator evaluator_;
  std::vector<double> start_;
  double radius_;
  std::size_t method_;  ///< of kOptimisers
  std::vector<Function> on_design_;
  std::vector<std::string> refusals_;
  std::shared_ptr<const shape::DesignState> best_;  // the last one accepted
  bool refused_ = false;
  Stopping stopping_{*this};
};

std::shared_ptr<OptimumHandle> optimise(Call& call) {
  Watch watch(call.state(), "optimising");
  Run run(call, call.self<Shape>(), watch);
  const auto handle = run.run();
  watch.answer("look at it, go on from it (start = that result), or leave it");
  return handle;
}

std::vector<Record> history(const OptimumHandle& o) {
  std::vector<Record> records;
  for (std::size_t k = 0; k < o.optimum.history.size(); ++k) records.push_back(design_record(o.optimum.history[k], o.refusals[k]));
  return records;
}

Record cost(const OptimumHandle& o) {
  const shape::EvaluatorCost& c = o.cost;
  return {"cost",
          {{"designs", o.optimum.history.size()}, {"seconds", o.optimum.history.empty() ? 0 : o.optimum.history.back().seconds},
           {"analyses", c.designs.analyses}, {"analysis_seconds", c.analysis_seconds}, {"iterations", c.designs.iterations},
           {"derivatives", c.designs.derivatives + c.beside.analyses}, {"derivative_seconds", c.derivative_seconds},
           {"derivative_iterations", c.beside.iterations}}};
}

std::vector<Key> optimise_keys() {
  using shape::Stopping;
  return {key::choice("method", kOptimisers,
                      "slp: sequential linear programming with a trust region (simplex method of GLPK), quadratically convergent where bounds and "
                      "constraints settle the design. mma: moving asymptotes, ccsaq: the same with quadratic models, slsqp: sequential quadratic "
                      "programming, best where the optimum lies inside the bounds, as that of peak_pressure mostly does (all three of NLopt)").fallback("slp"),
          key::either("start", {key::vector("", "").count(1, 4096), key::object<OptimumHandle>("", "")},
                      "the first design, or where an earlier run ended: slp goes on with its radius").unit("length").otherwise("as given to dotyk.shape"),
          key::number("radius", "of slp's first trust region, a share of the variables' ranges; of an optimum as start its own").above(0).within(0, 1).fallback(0.1),
          key::number("tol_design", "ends where a step changes every variable by less, a share of its range").above(0).into(&Stopping::tol_design),
          key::number("tol_gap", "ends where the linearised problem promises less over the whole box, relative to what it did at first").at_least(0).into(&Stopping::tol_gap),
          key::integer("max_designs", "evaluated at most").within(1, 100000).into(&Stopping::max_designs),
          key::function("on_design", "f(k, record, design), design only of admissible ones; false stops with the best so far"),
          key::file("figures", "a file for a figure of each design, with a place for its number: images/shape_%03d.png"),
          key::file("file", "written after each better design: shape:optimise(dofile(file)) goes on from there").written()};
}

}  // namespace

void bind_optimum(Library& library) {
  library.extend<Shape>().method(
      {.name = "shape:optimise",
       .help = "Seeks the least objective within bounds and constraints. Designs that cannot be solved (cells inverted, bodies overlapping, no "
               "solution) are answered by shorter steps. Ctrl-C at the prompt, or on_design returning false, ends with the best design so far; as "
               "start of another run it goes on from there.",
       .example = "local best = shape:optimise{ max_designs = 5, on_design = function(k, d) print(k, d.objective) end }\n"
                  "print(best.objective, best.reason)\nlocal better = shape:optimise{ start = best, max_designs = 5 }",
       .arguments = {key::table(optimise_keys())},
       .run = optimise});
  library.type<OptimumHandle>("Where an optimisation ended.")
      .field("alpha", "the best design's variables", [](const OptimumHandle& o) { return list(o.optimum.alpha); }, "length")
      .field("objective", "its objective", [](const OptimumHandle& o) { return o.optimum.value.objective; })
      .field("constraints", "how much its constraints exceed their bounds: at most 0 where they are kept", [](const OptimumHandle& o) { return list(o.optimum.value.constraints); })
      .field("multipliers", "of the constraints", [](const OptimumHandle& o) { return list(o.optimum.multipliers); })
      .field("gap", "what the first order still promises over the whole box, relative to what it did at first", [](const OptimumHandle& o) { return o.optimum.gap; })
      .field("radius", "of slp's next trust region; 0 of others", [](const OptimumHandle& o) { return o.optimum.radius; })
      .field("converged", "did it end by itself, constraints kept, gap at most 1e-3", [](const OptimumHandle& o) { return o.optimum.converged; })
      .field("reason", "why it ended", [](const OptimumHandle& o) { return o.optimum.reason; })
      .field("history", "one entry a design: design alpha objective constraints admissible accepted radius gap seconds", history)
      .field("cost", "designs, seconds; analyses, analysis_seconds and iterations (of the solver); derivatives (problems solved for them: adjoint and "
                     "directional ones, of differences analyses beside), derivative_seconds and derivative_iterations (of differences)", cost)
      .field("design", "the best design", [](const OptimumHandle& o) { return o.design; })
      .field("solution", "its solution", [](const OptimumHandle& o) { return o.design->state->solution(); })
      .text([](const OptimumHandle& o) {
        return text("optimum: objective ", o.optimum.value.objective, " after ", o.optimum.history.size(), " designs, ",
                    o.optimum.converged ? "converged" : "not converged", " (", o.optimum.reason, ")");
      });
}

}  // namespace dotyk::script

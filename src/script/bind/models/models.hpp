#pragma once
// Beams, thermoelastic ones, plates and contact problems of files for scripts, and for the calls that solve and draw them.
#include "beam/solve.hpp"
#include "fclib/contact_problem.hpp"
#include "plate/solution.hpp"
#include "script/bridge/library.hpp"
#include "script/bridge/wrapped.hpp"
#include "thermoelastic/stepping.hpp"

namespace dotyk::script {

// What solving a beam gives: its solution of least energy, and all local minima.
struct BeamResult {
  std::vector<beam::Branch> branches;  // least energy first
  std::size_t shown = 0;               // which of them this is
  const beam::Solution& solution() const { return *branches[shown].solution; }
};

// A number that is a function of the place is NaN; the function is kept with the object under the number's name.
template <> struct Wrapped<problem::LawChoice> : Called<"law"> {};
template <> struct Wrapped<beam::Beam> : Called<"beam"> {};
template <> struct Wrapped<BeamResult> : Called<"beam_solution"> {};

// A key for a law of dotyk.law at one point; the law given, else free. Throws InputError where it is friction that follows a normal force, or of functions.
Key law_key(const char* name, const char* help);
problem::LawChoice law(const Arguments& from, const char* name);
// Along a part a law may also be a function of the place that gives laws. Null where none is given; for use during the call only.
using LawOfPlace = std::function<problem::LawChoice(std::span<const double>)>;
Key law_field_key(const char* name, const char* help);
LawOfPlace law_field(const Arguments& from, const char* name);
// The same of beams and plates, which have no friction that follows a normal force.
LawOfPlace law_field_without_normal(const Arguments& from, const char* name);
// The keys of a law's numbers, numbers or functions, and the law that a call gives.
std::vector<Key> law_number_keys(const problem::LawSpec& spec);
Given<problem::LawChoice> make_law(Call& call, const problem::LawSpec& spec);
// Is the key for where the law `name` stands given? Throws InputError where there is no such law that could be there.
bool stands_somewhere(const Arguments& from, const char* name);
// A constant, or a function, which of(its field) makes of it; as they are where the key is not given.
template <class Function, class Of>
void take_field(const Arguments& from, const char* name, double& constant, Function& function, Of of) {
  if (!from.has(name)) return;
  const Field field = from.field(name);
  if (field.constant()) constant = field({})[0];
  else function = of(field);
}
// The keys for the laws of a support, and for where on a beam a value is asked.
inline std::vector<Key> support_law_keys() { return {law_key("deflection", "a law of dotyk.law"), law_key("rotation", "a law of dotyk.law")}; }
inline std::vector<Key> x_key() { return {key::number("x", "from the left end").unit("length").required()}; }

// A method `name` for a value at x.
template <class T>
void add_value(TypeOf<T>& type, const char* name, const char* help, int (*run)(Call&), const char* example) {
  type.method({.name = std::string(Wrapped<T>::name) + ":" + name, .help = help, .example = example, .arguments = x_key(), .run = run});
}

// A support told by "left", "right" or its x, and its place in Beam::supports; throws InputError where there is none.
Key support_key(std::string name);
int find_support(const beam::Beam& beam, const Arguments& from, const std::string& name);

// Functions of its loads are kept with the object.
struct ThermoelasticBeam {
  std::unique_ptr<thermoelastic::Stepping> stepping;
  thermoelastic::Loads constants;
  bool loads_called = false;  // its functions may not step it, nor draw it
};
template <> struct Wrapped<ThermoelasticBeam> : Called<"thermoelastic_beam"> {};

// The object before the colon and its loads. While this is there their functions may be called, and a second one is refused with
// InputError, `what` they cannot do.
struct CalledLoads {
  std::shared_ptr<ThermoelasticBeam> beam;
  thermoelastic::Loads loads;
  CalledLoads(const Call& call, const char* what);
  ~CalledLoads() { beam->loads_called = false; }
  CalledLoads(const CalledLoads&) = delete;
  CalledLoads& operator=(const CalledLoads&) = delete;
};

template <> struct Wrapped<plate::Model> : Called<"plate"> {};
template <> struct Wrapped<plate::Solution> : Called<"plate_solution"> {};

// The place in Plate::edges of a part that has laws; throws InputError where there is none of that name.
int find_edge(const plate::Plate& plate, const std::string& part);

// Frictional contact problems from files; a result remembers its problem.
template <> struct Wrapped<fclib::ContactProblem> : Called<"contact_problem"> {};

struct ContactProblemResult {
  std::shared_ptr<fclib::ContactProblem> problem;
  fclib::Result result;
  double seconds = 0;
};
template <> struct Wrapped<ContactProblemResult> : Called<"contact_problem_result"> {};

std::shared_ptr<ContactProblemResult> solve_contact_problem(const std::shared_ptr<fclib::ContactProblem>& problem,
                                                            const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::script

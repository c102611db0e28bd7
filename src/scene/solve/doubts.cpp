#include "scene/solve/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>

#include "algebra/dense/null_space.hpp"
#include "base/text.hpp"

namespace dotyk::scene {

namespace {

/// Linear elements lock where the material is nearly incompressible: constant volume in every cell leaves them too few motions.
constexpr double kLocks = 0.45;

/// Poisson's ratio of the isotropic tensor nearest to this one (by its two linear invariants, c_iijj and c_ijij): λ/2(λ + μ) in its own
/// dimension, so that ½ is where the ratio of bulk to shear modulus is infinite; in plane stress below ⅓ always.
double poisson_ratio(const elasticity::Hooke& hooke) {
  const int d = hooke.dimension;
  double bulk = 0, all = 0;  // isotropic: d²λ + 2dμ and dλ + (d² + d)μ
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) bulk += hooke.c[i][i][j][j], all += hooke.c[i][j][i][j];
  const double mu = (d * all - bulk) / (d * (d * d + d - 2)), lambda = (bulk - 2 * d * mu) / (d * d);
  return lambda / (2 * (lambda + mu));
}

void add_locking(const Body& body, std::vector<std::string>& all) {
  const mesh::ElementTopology& cells = body.mesh->topology();
  if (cells.order > 1) return;
  const elasticity::MaterialField& material = body.unrefined ? body.unrefined->material : body.material;
  const int count = (body.unrefined ? *body.unrefined->mesh : *body.mesh).cell_count();
  double nu = poisson_ratio(material.at(0));
  for (int c = 1; material.varies() && c < count; ++c) nu = std::max(nu, poisson_ratio(material.at(c)));
  if (nu > kLocks)
    all.push_back(text("'", body.name, "' is nearly incompressible (nu = ", nu, "): ", cells.name, " ", cells.shapes,
                       " lock, displacements come out too small, and error_estimate() notices too little of it; take second-order cells (",
                       cells.nodes == cells.dimension + 1 ? "element = \"P2\"" : "element = \"Q2\" or \"P2\"", ")"));
}

constexpr const char* kFinerFacets = "; take cells of order 2 (P2, Q2), nodes that match, or finer facets";

/// Gaps that chords make uncertain by more than this part of the interference, or of how gaps differ.
constexpr double kMostOfGap = 0.01;

/// Facets of curved parts whose nodes do not match are chords of different places: gaps are uncertain by the chords' height. Pressure comes from
/// the interference, or from what the gap differs by where bodies meet.
void see_chords(const Contact& contact, std::vector<std::string>& all) {
  double least = INFINITY, most = -INFINITY, chord = 0;
  for (const contact::ContactRow& row : contact.rows) least = std::min(least, row.gap), most = std::max(most, row.gap), chord = std::max(chord, row.chord);
  const bool fit = contact.interference || least < 0;
  const double scale = fit ? std::max(0.0, -least) : most - least;
  if (contact.rows.empty() || chord <= std::max(kMostOfGap * scale, 1e-12 * contact.first.body->mesh->size())) return;
  const std::string of = fit ? "the interference" : "what gaps differ by";
  all.push_back(text(contact.name, ": facets are chords up to ", chord, " off the curve, ",
                     scale > chord ? text(std::round(100 * chord / scale), " % of ", of, ", ", scale) : scale > 0 ? text("no less than ", of, ", ", scale) : "which leaves nothing of " + of,
                     ": the pressure is uneven", kFinerFacets));
}

/// A pressure that chords make uncertain by more than this part of the contact's greatest.
constexpr double kMostByChords = 0.05;
/// So much of a chord's height a node's gap has beside its neighbours'. Measured: pressed rings of Q1 with 24 and 17 to 240 and 167 cells a quarter have
/// pressures that differ by 1/200 to 1/35 of k_r chord.
constexpr double kUneven = 1.0 / 30;

/// The same after a solve, for nodes that press and for those whose gap is smaller than the chord's height. The pressure of a node is uncertain by
/// the stiffness of its row times the error of its gap. `x`: the negative gap of each row.
void see_chords(const Solution& solution, const algebra::Vector& x, std::size_t index, std::vector<std::string>& all) {
  const Contact& contact = *solution.scene().contacts[index];
  double greatest = 0, uncertain = 0, chord = 0;
  for (std::size_t i = 0; i < contact.rows.size(); ++i) {
    const int row = solution.model().contact_row[index][i];
    if (row < 0 || !(solution.active(row) || -x[row] < contact.rows[i].chord)) continue;
    const double measure = solution.model().normal[index][i].measure;
    greatest = std::max(greatest, solution.result().state.lambda[row] / measure);
    uncertain = std::max(uncertain, kUneven * solution.measure().stiffness()[row] * contact.rows[i].chord / measure);
    chord = std::max(chord, contact.rows[i].chord);
  }
  if (greatest == 0) return see_chords(contact, all);
  if (uncertain > kMostByChords * greatest && chord > 1e-12 * contact.first.body->mesh->size())
    all.push_back(text(contact.name, ": facets are chords up to ", chord, " off the curve: pressures of single nodes are uncertain by up to ", uncertain,
                       ", the greatest is ", greatest, kFinerFacets));
}

/// A pressure that is uncertain by more than this part of the contact's greatest says nothing.
constexpr double kMostRounding = 0.01;
/// Beside all forces on the bodies a contact's force below this part is none.
constexpr double kNoForce = 1e-5;

/// Where cells are so thin that rounding of their stiffness is beside the pressure.
void see_rounding(const Solution& solution, std::size_t index, std::vector<std::string>& all) {
  const Contact& contact = *solution.scene().contacts[index];
  double greatest = 0, uncertain = 0;
  std::size_t worst = 0;
  bool bears = false;
  const problem::Measure& all_forces = solution.measure();
  for (std::size_t i = 0; i < contact.rows.size(); ++i) {
    const int row = solution.model().contact_row[index][i];
    if (row < 0) continue;
    const double measure = solution.model().normal[index][i].measure;
    greatest = std::max(greatest, solution.result().state.lambda[row] / measure);
    bears = bears || solution.result().state.lambda[row] > kNoForce * all_forces.force_of_row(row);
    if (const double here = solution.rounding_of_forces()[row] / measure; here > uncertain) uncertain = here, worst = i;
  }
  if (bears && uncertain > kMostRounding * greatest)
    all.push_back(text(contact.name, ": rounding leaves the pressure uncertain by ", uncertain, " at ",
                       point_text(contact.first.body->mesh->point(contact.rows[worst].node).data(), contact.first.body->dimension()), ", the greatest is ", greatest,
                       ": cells there are too thin, or bodies move too far beside how they deform; grade the mesh less"));
}

/// Where supports hold the contact across everywhere: they bear what presses, and no friction comes of it.
void see_held(const Solution& solution, std::size_t index, std::vector<std::string>& all) {
  const Contact& contact = *solution.scene().contacts[index];
  const std::vector<int>& row = solution.model().contact_row[index];
  const problem::LawChoice& law = contact.normal.law;
  if (const auto held = std::count(row.begin(), row.end(), -1); held > 0 && law->acts() && !law->stop() && !law->prescribes)
    all.push_back(text(contact.name, ": supports hold ", held, " of its ", row.size(), " nodes across the contact; what its law (", law.spec->words,
                       ") would give there is left out of forces and energy"));
  if (contact.tangential->follows && std::all_of(row.begin(), row.end(), [](int r) { return r < 0; }))
    all.push_back(contact.name + ": supports hold all of it across the contact: they bear what presses, not the contact, and there is no friction");
}

/// A contact's row of B, and the contact row where it acts.
struct Acting {
  int row;
  const Contact* contact;
  const contact::ContactRow* at;
};

/// The rows that bear forces free to change, pressures and friction that sticks, and may depend on one another: at nodes with rows of several
/// sides or contacts; with P1-P0 multipliers all.
std::vector<Acting> may_depend(const Solution& solution) {
  const Scene& scene = solution.scene();
  std::map<std::pair<const Body*, int>, int> count;
  const auto nodes = [](const Contact& contact, const contact::ContactRow& row) {
    std::vector<std::pair<const Body*, int>> own{{contact.first.body.get(), row.node}};
    if (row.partners.size() == 1) own.emplace_back(contact.second.body.get(), row.partners.front().node);
    return own;
  };
  for (const auto& contact : scene.contacts)
    for (const contact::ContactRow& row : contact->rows)
      for (const auto& node : nodes(*contact, row)) ++count[node];
  const problem::Problem& problem = solution.model().problem;
  const algebra::Vector x = problem::jumps(problem, solution.result().state.u);
  const problem::Measure& measure = solution.measure();
  // A point of friction without slip may bear less, though it bears all that it can.
  const auto rests = [&](int r) { return std::abs(x[r]) <= 1e-8 * measure.length_of_row(r); };
  std::vector<Acting> acting;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = *scene.contacts[c];
    const auto meets = [&](const contact::ContactRow& row) {
      if (contact.discretisation.multipliers != contact::Multipliers::nodal) return true;
      const auto own = nodes(contact, row);
      return std::any_of(own.begin(), own.end(), [&](const auto& node) { return count[node] > 1; });
    };
    for (std::size_t k = 0; k < contact.rows.size(); ++k)
      if (const int r = solution.model().contact_row[c][k]; r >= 0 && solution.active(r) && meets(contact.rows[k])) acting.push_back({r, &contact, &contact.rows[k]});
    for (const FrictionRows& friction : solution.model().friction[c]) {
      const contact::ContactRow& at = contact.rows[friction.cell.jumps.front().row];
      for (int i = 0; i < friction.count; ++i)
        if (const int r = friction.row[i]; solution.result().state.lambda[r] != 0 && rests(r) && meets(at)) acting.push_back({r, &contact, &at});
    }
  }
  return acting;
}

/// To so many rows that may depend on one another their rank is looked at.
constexpr std::size_t kMostDependent = 2000;

/// Combinations of forces that do nothing to the bodies.
void see_dependent(const Solution& solution, std::vector<std::string>& all) {
  const std::vector<Acting> acting = may_depend(solution);
  if (acting.empty() || acting.size() > kMostDependent) return;
  const algebra::SparseRows& B = solution.model().problem.B;
  algebra::SparseMatrix columns(B.cols(), static_cast<Eigen::Index>(acting.size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    columns.startVec(k);
    for (algebra::SparseRows::InnerIterator it(B, acting[static_cast<std::size_t>(k)].row); it; ++it) columns.insertBack(it.col(), k) = it.value();
  }
  columns.finalize();
  const algebra::SparseMatrix lost = algebra::range_and_null(columns, 1e-10).unseen;
  if (lost.cols() == 0) return;
  Eigen::Index most;
  algebra::Vector(lost.col(0)).cwiseAbs().maxCoeff(&most);
  const Acting& one = acting[static_cast<std::size_t>(most)];
  all.push_back(text(one.contact->name, ": forces of contact that meet ", lost.cols() > 1 ? text("in ", lost.cols(), " places, one of them ") : "",
                     "at ", point_text(one.contact->first.body->mesh->point(one.at->node).data(), one.contact->first.body->dimension()),
                     " balance each other in part: pressure and shear there are not unique, the method decides; displacements and the force on each node are"));
}

/// Strains and rotations (of 1, and in radians) beyond which the equations, those of small ones, are off by as much as one cares for.
constexpr double kGreat = 0.05;
/// Shares of a body that speak for it, whatever cells at corners and ends of contact do: cells with half of its energy, or a tenth of its size.
constexpr double kOfEnergy = 0.5, kOfSize = 0.1;

using elasticity::CellDeformation;

/// The value that cells with such a share of the weight exceed.
double exceeded(std::vector<CellDeformation> cells, double CellDeformation::*value, double CellDeformation::*weight, double share) {
  std::ranges::sort(cells, std::greater(), value);
  double left = 0;
  for (const CellDeformation& cell : cells) left += share * cell.*weight;
  for (const CellDeformation& cell : cells)
    if ((left -= cell.*weight) <= 0) return cell.*value;
  return 0;
}

/// Where strains or rotations are beyond what the equations are made for.
void see_great(const Body& body, const std::vector<double>& u, std::vector<std::string>& all) {
  if (body.unrefined) return;  // its cells are with the ranks
  const std::vector<CellDeformation> cells = elasticity::cell_deformation(*body.mesh, body.material, u);
  const auto see = [&](double CellDeformation::*value, double most, const std::string& what) {
    if (most <= kGreat) return;
    const auto cell = std::ranges::max_element(cells, {}, value) - cells.begin();
    all.push_back(text("'", body.name, what, ", most at ", point_text(body.mesh->cell_centre(static_cast<int>(cell)).data(), body.dimension()),
                       ": the equations are those of small strains and rotations, results are off by about as much"));
  };
  const double strain = exceeded(cells, &CellDeformation::strain, &CellDeformation::energy, kOfEnergy), angle = exceeded(cells, &CellDeformation::rotation, &CellDeformation::measure, kOfSize);
  see(&CellDeformation::strain, strain, text("' is strained by ", std::setprecision(2), 100 * strain, " % and more (where half of its energy is)"));
  see(&CellDeformation::rotation, angle, text("' turns by ", std::setprecision(2), angle, " radians and more (a tenth of it)"));
}

/// Where parts that press have slid along a ball, whose normal turns with the way, or along another body so far that other places face each other.
void see_slide(const Solution& solution, std::size_t index, std::vector<std::string>& all) {
  const Contact& contact = *solution.scene().contacts[index];
  const auto* ball = std::get_if<contact::RigidBall>(&contact.shape);
  const bool bodies = contact.second.body != nullptr;
  if (contact.kind == Contact::Kind::glue || contact.first.body->unrefined || !(bodies || ball)) return;
  const double size = bodies ? std::min(contact.first.body->mesh->size(), contact.second.body->mesh->size()) : ball->radius;
  double way = 0;
  for (const ContactNode& node : solution.contact(contact).nodes)
    if (node.pressure > 0) way = std::max(way, mesh::length(node.slip));
  if (way > kGreat * size)
    all.push_back(text(contact.name, ": what presses slides by ", std::setprecision(2), way / size, " times the ", bodies ? "size of the smaller body" : "radius",
                       ": contact is that of what faces each other before the load, results are off by about as much"));
}

}  // namespace

std::vector<std::string> doubts(const Scene& scene) {
  std::vector<std::string> all;
  for (const auto& body : scene.bodies) add_locking(*body, all);
  for (const auto& contact : scene.contacts) see_chords(*contact, all);
  return all;
}

std::vector<std::string> doubts(const Solution& solution) {
  std::vector<std::string> all;
  for (const auto& body : solution.scene().bodies) add_locking(*body, all);
  const algebra::Vector x = problem::jumps(solution.model().problem, solution.result().state.u);
  for (std::size_t c = 0; c < solution.scene().contacts.size(); ++c) {
    see_chords(solution, x, c, all);
    see_held(solution, c, all);
    if (solution.result().converged) see_rounding(solution, c, all), see_slide(solution, c, all);
  }
  if (solution.result().converged) see_dependent(solution, all);
  for (std::size_t b = 0; solution.result().converged && b < solution.scene().bodies.size(); ++b)
    see_great(solution.body(static_cast<int>(b)), solution.displacement(static_cast<int>(b)), all);
  return all;
}

std::string describe(const std::vector<std::string>& doubts) {
  std::string out;
  for (const std::string& one : doubts) out += "\n  warning: " + one;
  return out;
}

}  // namespace dotyk::scene

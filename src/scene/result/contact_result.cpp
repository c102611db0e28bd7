#include <algorithm>
#include <cmath>
#include <iomanip>

#include "base/whole_file.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;

/// Pressures: the values of the pressure at the contact rows, λ/∫ψ a basis function.
std::vector<double> pressures(const Contact& contact, const Model& model, int index, const algebra::Vector& lambda) {
  std::vector<double> value(contact.rows.size(), 0);
  for (std::size_t j = 0; j < value.size(); ++j) {
    const int r = model.contact_row[index][j];
    const contact::NormalRow& row = model.normal[index][j];
    if (r < 0 || !(row.measure > 0)) continue;
    for (const contact::Term& at : row.values) value[at.row] += at.weight * lambda[r] / row.measure;
  }
  return value;
}

/// Shear on the first body at the contact rows: μ g, where a node lies in several cells the mean by their share
/// of its surroundings; and whether it slips (at least half of these cells, by share, do) or sticks.
struct Rubbing {
  std::vector<Point> shear;
  std::vector<char> rubs, slips;
};

Rubbing rubbing(const Contact& contact, const Model& model, int index, const solver::Result& result) {
  const std::size_t count = contact.rows.size();
  Rubbing rubbing{std::vector<Point>(count, Point{0, 0, 0}), std::vector<char>(count, 0), std::vector<char>(count, 0)};
  std::vector<double> slipping(count, 0), sticking(count, 0);
  const bool given = contact.tangential->tresca(), capped = contact.tangential->elastic() && contact.tangential->yields();
  for (const FrictionRows& rows : model.friction[index]) {
    bool slips = false;
    for (int i = 0; i < rows.count; ++i) slips = slips || (capped ? !result.active_sets.empty() && !result.active_sets.back()[rows.row[i]] : !result.slipping.empty() && result.slipping[rows.row[i]]);
    for (const contact::Term& node : rows.cell.nodes) {
      const double g = given ? contact.tangential[node.row].numbers[0] : INFINITY;
      const double density = node.weight * (std::isfinite(g) ? g / rows.cell.bound : 1 / rows.cell.measure);
      for (int i = 0; i < rows.count; ++i) {
        const Point t = rows.at(i, contact.rows[node.row], contact.first.body->dimension());
        for (int k = 0; k < 3; ++k) rubbing.shear[node.row][k] -= density * result.state.lambda[rows.row[i]] * t[k];
      }
      rubbing.rubs[node.row] = contact.tangential->rubs() || capped;
      (slips ? slipping : sticking)[node.row] += node.weight;
    }
  }
  for (std::size_t k = 0; k < count; ++k) rubbing.slips[k] = slipping[k] > (1 - 1e-9) * sticking[k];
  return rubbing;
}

/// The multipliers of these rows alone.
algebra::Vector friction_part(const std::vector<FrictionRows>& friction, const algebra::Vector& lambda) {
  algebra::Vector part = algebra::Vector::Zero(lambda.size());
  for (const FrictionRows& rows : friction)
    for (int i = 0; i < rows.count; ++i) part[rows.row[i]] = lambda[rows.row[i]];
  return part;
}

/// Where the row's force acts: at its node, but for a mean over nodes that lies elsewhere.
Point acting_at(const mesh::Mesh& mesh, const contact::ContactRow& row) {
  const Point x = contact::mean_place(row.own, mesh), node = mesh.point(row.node);
  return mesh::length(mesh::minus(x, node)) > 1e-9 * mesh.size() ? x : node;
}

/// The place whose pressure (and shear) the row's is, a mean weighted with the node's hat function: where facets about it are unlike, as at ends of the
/// part, off the node. A hat's means are 2/3 and 1/3 on a segment, 1/2 and 1/4 on a triangle, 4/9, 2/9, 1/9 and 2/9 around a quadrilateral.
Point hat_centre(const mesh::Mesh& mesh, const Part& part, const contact::ContactRow& row) {
  const int corners = mesh.topology().facet_corners;
  Point moment{0, 0, 0};
  double sum = 0;
  for (const int f : row.facets) {
    const mesh::Facet& facet = part.facets[static_cast<std::size_t>(f)];
    const double area = mesh::length(mesh.facet_area_vector(facet));
    int own = 0;
    while (own + 1 < corners && mesh.facet_node(facet, own) != row.node) ++own;
    for (int a = 0; a < corners; ++a) {
      const double weight = corners == 4 ? (a == own ? 4 : std::abs(a - own) == 2 ? 1 : 2) / 9.0 : (a == own ? 2 : 1) / (corners + 1.0);
      moment = mesh::plus(moment, mesh::times(area * weight, mesh.point(mesh.facet_node(facet, a))));
    }
    sum += area;
  }
  return sum > 0 ? mesh::times(1 / sum, moment) : mesh.point(row.node);
}

/// By how much the row's surroundings yield to its pressure, per pressure: the width over so many shear moduli, of both sides (where they vary, of the first cell). In Hertz's contact
/// pressure times h/(¾E*), E* some 3G, and the gap, h to either side of the edge of contact, are on a line that is 0 there; means over surroundings
/// (order 2) put more pressure on the last node. The factors make the mean error least on meshes of 4 to 17 facets in contact.
double yielding(const Contact& contact, const contact::ContactRow& row) {
  const auto modulus = [](const Body& body) { return (body.unrefined ? body.unrefined->material : body.material).at(0).c[0][1][0][1]; };
  double sum = 1 / modulus(*contact.first.body);
  if (contact.second.body) sum += 1 / modulus(*contact.second.body);
  const double factor = contact.first.body->mesh->topology().order == 1 ? 3 : 6;
  return std::pow(row.weight, 1.0 / (contact.first.body->dimension() - 1)) * sum / factor;
}

/// Of the way from one node to the middle of the way to another, the part that presses; `here` and `there` are positive where they do.
double pressing(double here, double there) {
  if ((here > 0) == (there > 0)) return here > 0 ? 1 : 0;
  const double edge = 2 * here / (here - there);
  return here > 0 ? std::min(edge, 1.0) : std::max(1 - edge, 0.0);
}

/// Where it presses: a node's share, and next to nodes that do not press what the edge of contact between them leaves of it.
double pressed_area(const Contact& contact, const std::vector<ContactNode>& nodes) {
  const auto neighbours = contact::neighbours(contact.rows);
  const bool one_sided = contact.normal->stop();
  std::vector<double> at;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    at.push_back(!one_sided || contact.rows[k].facets.empty() ? (nodes[k].status != problem::Status::open ? 1 : -1)
                 : nodes[k].pressure > 0 ? nodes[k].pressure * yielding(contact, contact.rows[k]) : -std::max(nodes[k].gap, 0.0));
  double area = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double share = neighbours[k].empty() || !one_sided ? at[k] > 0 : 0;
    for (const int n : neighbours[k])
      if (one_sided) share += pressing(at[k], at[static_cast<std::size_t>(n)]) / static_cast<double>(neighbours[k].size());
    area += nodes[k].weight * share;
  }
  return area;
}

/// ",shear_x,shear_y".
std::string components(const std::string& name, int dim) {
  std::string out;
  for (int i = 0; i < dim; ++i) out += "," + name + "_" + "xyz"[i];
  return out;
}

}  // namespace

void NodeCount::add(problem::Status status, double weight, double pressure) {
  if (status != problem::Status::open) area += weight;
  max_pressure = std::max(max_pressure, pressure);
  switch (status) {
    case problem::Status::open: ++open; break;
    case problem::Status::closed: ++closed; break;
    case problem::Status::stick: ++stick; break;
    case problem::Status::slip: ++slip; break;
  }
}

ContactResult as_given(const Contact& contact, ContactResult result) {
  if (!contact.turned) return result;
  const auto turn = [](Point& p) {
    for (double& v : p) v = 0 - v;
  };
  turn(result.force), turn(result.friction_force);
  for (ContactNode& node : result.nodes) turn(node.normal), turn(node.shear), turn(node.slip);
  return result;
}

ContactResult Solution::contact(const Contact& asked) const {
  const int index = scene_->index_of(asked);
  if (index < 0)
    throw InputError(text("this contact (", asked.name, ") is not part of the scene that was solved"));
  const Contact& contact = *model_.contacts[index];  // as it is in this design
  if (contact.kind == Contact::Kind::glue)
    throw InputError(text(contact.name, " is a glue; only contacts have a pressure and a status"));
  const int first = scene_->index_of(contact.first.body.get());
  const int second = scene_->index_of(contact.second.body.get());
  const int dim = scene_->dimension();
  ContactResult result;
  for (const FrictionRows& rows : model_.friction[index])
    for (int i = 0; i < rows.count; ++i) result.dissipated += dissipated_[rows.row[i]];
  const std::vector<double> pressure = pressures(contact, model_, index, result_.state.lambda);
  const std::vector<Point> force = model_.contact_force(index, result_.state.lambda);
  const std::vector<Point> rubbed = model_.contact_force(index, friction_part(model_.friction[index], result_.state.lambda));
  const Rubbing rubbing = scene::rubbing(contact, model_, index, result_);
  for (std::size_t k = 0; k < contact.rows.size(); ++k) {
    const contact::ContactRow& row = contact.rows[k];
    const int r = model_.contact_row[index][k];
    ContactNode node;
    node.node = row.node;
    node.x = scene_->bodies[first]->mesh->point(row.node);
    node.displacement = mesh::at_node(displacement(first), row.node, dim);
    node.normal = row.normal;
    node.weight = row.weight;
    node.centre = hat_centre(*scene_->bodies[first]->mesh, contact.first, row);
    if (contact.pairing == contact::Pairing::mortar) node.x = acting_at(*scene_->bodies[first]->mesh, row);
    const Point other = second >= 0 ? contact::mean(row.partners, displacement(second), dim) : model_.move[index];
    const Point jump = mesh::minus(contact::mean(row.own, displacement(first), dim), other);
    const double normal_jump = mesh::dot(row.normal, jump);
    node.gap = row.gap - normal_jump;
    for (int i = 0; i < 3; ++i) node.slip[i] = jump[i] - normal_jump * row.normal[i];
    node.pressure = pressure[k];
    node.force = pressure[k] * row.weight;
    node.shear = rubbing.shear[k];
    const bool pulled = contact.tangential->follows && node.pressure < 0;  // slides freely
    const bool follows = r >= 0 ? active(r) : node.pressure > 0;
    if (contact.normal->acts() && problem::status_of(*contact.normal.operator->(), follows, node.pressure != 0) != problem::Status::open) node.status = problem::Status::closed;
    if ((node.status == problem::Status::closed || !contact.normal->acts()) && rubbing.rubs[k])
      node.status = rubbing.slips[k] || pulled ? problem::Status::slip : problem::Status::stick;
    for (int i = 0; i < 3; ++i) {
      result.force[i] += force[k][i];
      result.friction_force[i] += rubbed[k][i];
    }
    result.add(node.status, node.weight, node.pressure);
    result.nodes.push_back(node);
  }
  result.area = pressed_area(contact, result.nodes);
  return result;
}

void write_contact(const Solution& solution, const std::string& file) {
  const int dim = solution.scene().dimension();
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(17) << "contact,node,x,y" << (dim == 3 ? ",z" : "")
      << ",gap,pressure,force,weight" << components("shear", dim) << components("slip", dim) << ",status\n";
  int number = 0;
  for (const auto& contact : solution.scene().contacts) {
    ++number;
    if (contact->kind != Contact::Kind::contact) continue;
    for (const ContactNode& n : as_given(*contact, solution.contact(*contact)).nodes) {
      out << number << ',' << n.node + 1;
      for (int i = 0; i < dim; ++i) out << ',' << n.x[i];
      out << ',' << n.gap << ',' << n.pressure << ',' << n.force << ',' << n.weight;
      for (const mesh::Point& vector : {n.shear, n.slip})
        for (int i = 0; i < dim; ++i) out << ',' << vector[i];
      out << ',' << problem::status_name(n.status) << '\n';
    }
  }
  write_whole_file(file, out.str());
}

}  // namespace dotyk::scene

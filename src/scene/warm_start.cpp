#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/solution.hpp"

namespace dotyk::scene {

namespace {

/// Is the contact node of `known` nearest to x closed?
bool closed_nearby(const ContactResult& known, const mesh::Point& x) {
  double nearest = INFINITY;
  bool closed = false;
  for (const ContactNode& node : known.nodes) {
    const mesh::Point off = mesh::minus(x, node.x);
    const double d = mesh::dot(off, off);
    if (d < nearest) {
      nearest = d;
      closed = node.status != problem::Status::open;
    }
  }
  return closed;
}

/// The result of the coarse scene's contact of this number; empty where it has none.
std::optional<ContactResult> counterpart(const Solution& coarse, std::size_t c) {
  const auto& contacts = coarse.scene().contacts;
  if (c >= contacts.size() || contacts[c]->kind != Contact::Kind::contact) return std::nullopt;
  return coarse.contact(*contacts[c]);
}

}  // namespace

bool same_rows(const Scene& scene, const Model& model, const Solution& solution) {
  const Scene& other = solution.scene();
  const Model& known = solution.model();
  bool same = known.problem.rows() == model.problem.rows() && known.problem.unknowns() == model.problem.unknowns() &&
              known.contact_row == model.contact_row && other.bodies.size() == scene.bodies.size() &&
              other.contacts.size() == scene.contacts.size();
  for (std::size_t b = 0; same && b < scene.bodies.size(); ++b) same = other.bodies[b]->mesh == scene.bodies[b]->mesh;
  for (std::size_t c = 0; same && c < scene.contacts.size(); ++c) {
    const auto &one = scene.contacts[c]->rows, &two = other.contacts[c]->rows;
    same = scene.contacts[c]->kind == other.contacts[c]->kind && one.size() == two.size();
    for (std::size_t k = 0; same && k < one.size(); ++k) same = one[k].node == two[k].node;
  }
  return same;
}

std::vector<char> start_flags(const Scene& scene, const Model& model, const Start& start) {
  std::vector<char> flags(model.problem.rows(), 0);
  int number = 0;  // of the row over all contacts
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = *scene.contacts[c];
    if (contact.kind != Contact::Kind::contact) continue;
    const auto known = start.coarse ? counterpart(*start.coarse, c) : std::nullopt;
    for (std::size_t k = 0; k < contact.rows.size(); ++k, ++number) {
      const int r = model.contact_row[c][k];
      if (r < 0) continue;
      if (known)
        flags[r] = closed_nearby(*known, contact.first.body->mesh->point(contact.rows[k].node));
      else if (start.closed)
        flags[r] = std::find(start.closed->begin(), start.closed->end(), number) != start.closed->end();
    }
  }
  return flags;
}

}  // namespace dotyk::scene

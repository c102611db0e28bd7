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

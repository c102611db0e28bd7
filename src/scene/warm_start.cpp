#include <cmath>

#include "scene/solution.hpp"

namespace dotyk::scene {

std::vector<char> start_from(const Scene& scene, const Model& model, const Solution& coarse) {
  std::vector<char> start(model.problem.rows(), 0);
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const Contact& contact = *scene.contacts[c];
    if (contact.kind != Contact::Kind::contact || c >= coarse.scene().contacts.size() ||
        coarse.scene().contacts[c]->kind != Contact::Kind::contact)
      continue;
    const ContactResult known = coarse.contact(*coarse.scene().contacts[c]);
    for (std::size_t k = 0; k < contact.rows.size(); ++k) {
      const int r = model.contact_row[c][k];
      if (r < 0) continue;
      const mesh::Point x = contact.first.body->mesh->point(contact.rows[k].node);
      double nearest = INFINITY;
      for (const ContactNode& node : known.nodes) {
        double d = 0;
        for (int i = 0; i < 3; ++i) d += (x[i] - node.x[i]) * (x[i] - node.x[i]);
        if (d < nearest) {
          nearest = d;
          start[r] = node.status != problem::Status::open;
        }
      }
    }
  }
  return start;
}

}  // namespace dotyk::scene

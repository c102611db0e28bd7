#include <algorithm>
#include <array>
#include <map>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

namespace {

struct RowPlace {
  mesh::Point x;
  int row;
};

/// Whose rows: a contact's (-1, its number, 0) or a support's by laws (body, its number, which of its directions).
using Owner = std::array<int, 3>;

/// The rows of B that may open and close, by owner.
std::map<Owner, std::vector<RowPlace>> places(const Scene& scene, const Model& model) {
  std::map<Owner, std::vector<RowPlace>> all;
  const auto add = [&](const Owner& owner, const mesh::Point& x, int row) {
    if (row >= 0) all[owner].push_back({x, row});
  };
  for (int c = 0; c < static_cast<int>(scene.contacts.size()); ++c) {
    const Contact& contact = *scene.contacts[c];
    if (contact.kind != Contact::Kind::contact) continue;
    for (std::size_t k = 0; k < contact.rows.size(); ++k)
      add({-1, c, 0}, contact.first.body->mesh->point(contact.rows[k].node), model.contact_row[c][k]);
  }
  for (int b = 0; b < static_cast<int>(model.support_row.size()); ++b)
    for (int s = 0; s < static_cast<int>(model.support_row[b].size()); ++s) {
      const auto& nodes = model.bodies[b].laws[s].nodes;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const mesh::Point x = model.bodies[b].mesh->point(nodes[k].node);
        const SupportRows& rows = model.support_row[b][s][k];
        add({b, s, 0}, x, rows.normal);
        for (int i = 0; i < rows.count; ++i) add({b, s, 1 + i}, x, rows.row[i]);
      }
    }
  return all;
}

int nearest(const std::vector<RowPlace>& known, const mesh::Point& x) {
  const auto squared = [&](const RowPlace& at) {
    const mesh::Point off = mesh::minus(x, at.x);
    return mesh::dot(off, off);
  };
  return std::min_element(known.begin(), known.end(), [&](const RowPlace& a, const RowPlace& b) { return squared(a) < squared(b); })->row;
}

void close_named(const Scene& scene, const Model& model, const std::vector<int>& closed, std::vector<char>& flags) {
  int number = 0;  // of the row over all contacts
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    if (scene.contacts[c]->kind != Contact::Kind::contact) continue;
    for (const int r : model.contact_row[c]) {
      if (r >= 0) flags[r] = std::find(closed.begin(), closed.end(), number) != closed.end();
      ++number;
    }
  }
}

}  // namespace

bool same_rows(const Scene& scene, const Model& model, const Solution& solution) {
  const Scene& other = solution.scene();
  const Model& known = solution.model();
  bool same = known.problem.rows() == model.problem.rows() && known.problem.unknowns() == model.problem.unknowns() &&
              known.contact_row == model.contact_row && other.bodies.size() == scene.bodies.size() &&
              other.contacts.size() == scene.contacts.size();
  for (std::size_t b = 0; same && b < scene.bodies.size(); ++b) {
    const auto &one = model.bodies[b].laws, &two = known.bodies[b].laws;
    same = other.bodies[b]->mesh == scene.bodies[b]->mesh &&
           std::equal(one.begin(), one.end(), two.begin(), two.end(), [](const LawSupport& x, const LawSupport& y) { return x.part == y.part; });
  }
  for (std::size_t c = 0; same && c < scene.contacts.size(); ++c) {
    const auto &one = scene.contacts[c]->rows, &two = other.contacts[c]->rows;
    same = scene.contacts[c]->kind == other.contacts[c]->kind && one.size() == two.size();
    for (std::size_t k = 0; same && k < one.size(); ++k) same = one[k].node == two[k].node;
  }
  return same;
}

std::vector<char> start_flags(const Scene& scene, const Model& model, const Start& start) {
  const algebra::Vector& gap = model.problem.c;
  const double touching = 1e-12 * (gap.size() ? gap.lpNorm<Eigen::Infinity>() : 0);
  std::vector<char> flags;
  for (const double at_rest : gap) flags.push_back(at_rest <= touching);
  if (start.closed) close_named(scene, model, *start.closed, flags);
  if (!start.coarse) return flags;
  const auto known = places(start.coarse->scene(), start.coarse->model());
  for (const auto& [owner, rows] : places(scene, model))
    if (const auto found = known.find(owner); found != known.end())
      for (const RowPlace& at : rows) flags[at.row] = start.coarse->active(nearest(found->second, at.x));
  return flags;
}

}  // namespace dotyk::scene

#include <iomanip>
#include <sstream>

#include "base/whole_file.hpp"
#include "scene/result/solution.hpp"

namespace dotyk::scene {

namespace {

/// ",shear_x,shear_y".
std::string components(const std::string& name, int dim) {
  std::string out;
  for (int i = 0; i < dim; ++i) out += "," + name + "_" + "xyz"[i];
  return out;
}

}  // namespace

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

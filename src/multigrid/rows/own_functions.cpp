#include "multigrid/rows/own_functions.hpp"

namespace dotyk::multigrid {

Rows OwnFunctions::rows(int dimension) const {
  Rows rows;
  const auto nodes = static_cast<std::size_t>(std::ssize(starts) - 1), of_node = nodes > 0 ? component.size() / nodes : 1;
  const std::size_t most = of_node * means.size();
  rows.starts.reserve(component.size() + 1), rows.columns.reserve(most), rows.values.reserve(most);
  for (std::size_t r = 0; r < component.size(); ++r) {
    const int begin = starts[r / of_node], end = starts[r / of_node + 1];
    for (int k = begin; k < end && component[r] >= 0; ++k) {
      if (!(means[k] >> component[r] & 1)) continue;
      rows.columns.push_back(means[k] / kComponents * dimension + component[r]);
      rows.values.push_back(1.0 / (end - begin));
    }
    rows.starts.push_back(counted(rows.columns.size()));
  }
  sort_entries(rows.starts.data(), 0, counted(component.size()), rows.columns.data(), rows.values.data());
  return rows;
}

AllOwnFunctions without_first(const AllOwnFunctions& functions) {
  return std::make_shared<const std::vector<OwnFunctions>>(functions->begin() + 1, functions->end());
}

void send(const Ranks& ranks, int to, const AllOwnFunctions& functions) {
  ranks.send(to, std::vector<int>{counted(functions->size())});
  for (const OwnFunctions& own : *functions) ranks.send(to, own.component), ranks.send(to, own.starts), ranks.send(to, own.means);
}

AllOwnFunctions receive_own_functions(const Ranks& ranks, int from) {
  const std::vector<int> count = ranks.received<int>(from);
  auto all = std::make_shared<std::vector<OwnFunctions>>(static_cast<std::size_t>(count[0]));
  for (OwnFunctions& own : *all) ranks.receive(from, own.component), ranks.receive(from, own.starts), ranks.receive(from, own.means);
  return all;
}

}  // namespace dotyk::multigrid

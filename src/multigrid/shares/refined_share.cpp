#include "multigrid/shares/refined_share.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "multigrid/rows/own_rows.hpp"

namespace dotyk::multigrid {

PrescribedBits prescribed_bits(const std::vector<int>& rows, int dimension) {
  PrescribedBits bits;
  for (const int row : rows) bits[row / dimension] |= 1 << row % dimension;
  return bits;
}

namespace {

int bits_of(int node, const PrescribedBits& prescribed) {
  const auto at = prescribed.find(node);
  return at == prescribed.end() ? 0 : at->second;
}

std::span<const int> columns_of(const Rows& rows, std::size_t k) {
  return {rows.columns.data() + rows.starts[k], static_cast<std::size_t>(rows.starts[k + 1] - rows.starts[k])};
}

/// Nodes whose numbers other ranks know.
class Questions {
 public:
  explicit Questions(const Ranks& ranks) : ranks_(ranks), asked_(static_cast<std::size_t>(ranks.count())), places_(asked_) {}

  void ask(int rank, std::span<const int> means, std::size_t place) {
    asked_[rank].push_back(counted(means.size()));
    asked_[rank].insert(asked_[rank].end(), means.begin(), means.end());
    places_[rank].push_back(static_cast<int>(place));
  }
  /// Calls find(means) for what the others ask, and put(place, number) for what was asked. Collective.
  template <class Find, class Put>
  void answer(const Find& find, const Put& put) {
    std::vector<std::vector<int>> told(asked_.size());
    const auto of_others = ranks_.exchange(asked_);
    for (std::size_t r = 0; r < told.size(); ++r)
      for (std::size_t k = 0; k < of_others[r].size(); k += static_cast<std::size_t>(of_others[r][k]) + 1)
        told[r].push_back(find(std::span(of_others[r]).subspan(k + 1, static_cast<std::size_t>(of_others[r][k]))));
    told = ranks_.exchange(told);
    for (std::size_t r = 0; r < told.size(); ++r)
      for (std::size_t k = 0; k < told[r].size(); ++k) put(places_[r][k], told[r][k]);
  }

 private:
  const Ranks& ranks_;
  std::vector<std::vector<int>> asked_, places_;
};

/// Of each node of the refined cells the numbers of the nodes whose mean it is, ascending.
Rows by_number(const Buckets& means, const std::vector<int>& number) {
  Rows all;
  std::vector<int> row;
  for (int i = 0; i < means.count(); ++i) {
    for (const int p : means[i]) row.push_back(number[p]);
    all.append_columns(row);
  }
  return all;
}

/// Decides which rank owns a new node whose parents, the nodes whose mean it is, belong to different ranks. Let a be the rank of the parent with the least number, and b
/// that of the parent with the greatest. Then a owns the node if the least number is below a bound, and b owns it if not. There is one bound for each pair
/// (a, b), so that a border most often changes sides at one place only and stays short. Each bound is chosen so that the ranks have nodes in the same ratio as
/// before the refinement, as far as the nodes between a and b allow.
class Owners {
 public:
  /// `means`: for each node of this rank's refined cells, the numbers of its parents. The rank has all cells about its nodes; so every new node with a parent on this
  /// rank is among them. Collective.
  Owners(const Ranks& ranks, const Rows& means, const std::vector<int>& first) : first_(first) {
    std::map<int, std::vector<int>> between;  // for each other rank: the least numbers of the nodes between, where this rank is a; empty where it is b
    int halves = 0;                           // each own node counts 2, each node between this rank and another counts 1
    for (std::size_t i = 0; i + 1 < means.starts.size(); ++i) {
      const auto of = columns_of(means, i);
      const int low = rank_with(first, of.front()), high = rank_with(first, of.back());
      halves += (low == ranks.own()) + (high == ranks.own());
      if (low == high || (low != ranks.own() && high != ranks.own())) continue;
      std::vector<int>& least = between[low == ranks.own() ? high : low];
      if (low == ranks.own()) least.push_back(of.front());
    }
    const std::vector<int> shares = ranks.gather(halves), neighbours = ranks.gather(static_cast<int>(between.size()));
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    const auto surplus = [&](int rank) { return shares[rank] - all * (first[rank + 1] - first[rank]) / first.back(); };
    std::vector<int> told;
    for (auto& [other, least] : between) {
      if (least.empty()) continue;
      // How many more than half of the nodes between the two ranks this rank takes. If one of these nodes changes sides, the difference of the counts changes by four.
      const double more = (surplus(other) - surplus(ranks.own())) / (4 * std::max(neighbours[other], neighbours[ranks.own()]));
      const auto taken = std::clamp<std::ptrdiff_t>(std::lround(std::ssize(least) / 2.0 + more), 0, std::ssize(least));
      std::ranges::sort(least);
      told.insert(told.end(), {ranks.own(), other, taken < std::ssize(least) ? least[taken] : first[ranks.own() + 1]});
    }
    for (const std::vector<int>& in : ranks.exchange(std::vector<std::vector<int>>(first.size() - 1, told)))
      for (std::size_t k = 0; k < in.size(); k += 3) bound_[{in[k], in[k + 1]}] = in[k + 2];
  }

  /// The parent whose rank owns the new node. `of`: the numbers of its parents, ascending.
  int decides(std::span<const int> of) const {
    const int low = rank_with(first_, of.front()), high = rank_with(first_, of.back());
    return low == high || of.front() < bound_.at({low, high}) ? of.front() : of.back();
  }
  int rank(std::span<const int> of) const { return rank_with(first_, decides(of)); }

 private:
  const std::vector<int>& first_;
  std::map<std::pair<int, int>, int> bound_;
};

/// Flagged nodes in an order that depends on what they are the means of alone.
std::vector<int> own_in_order(const Rows& means, const std::vector<char>& own) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i]) nodes.push_back(static_cast<int>(i));
  std::ranges::sort(nodes, [&](int a, int b) {
    return std::ranges::lexicographical_compare(columns_of(means, static_cast<std::size_t>(a)), columns_of(means, static_cast<std::size_t>(b)));
  });
  return nodes;
}

/// The first of each rank, and the number of all, from the number of own ones. Collective.
std::vector<int> firsts(const Ranks& ranks, int own) {
  std::vector<int> first = ranks.gather(own);
  counted(std::accumulate(first.begin(), first.end(), std::size_t{0}));
  first.insert(first.begin(), 0);
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

}  // namespace

RefinedShare::RefinedShare(const Ranks& ranks, std::unique_ptr<algebra::Refinable> cells, int dimension, std::vector<int> number, std::vector<int> first, int layers)
    : ranks_(ranks), cells_(std::move(cells)), dimension_(dimension), layers_(layers), number_(std::move(number)), first_{std::move(first)} {}

std::vector<int> RefinedShare::refine(const Rows& asked) {
  const Rows means = by_number(cells_->refine(), number_);
  const std::vector<int>& first = first_.front();
  const int begin = first[ranks_.own()], end = first[ranks_.own() + 1];
  const Owners owners(ranks_, means, first);
  std::vector<char> own(means.starts.size() - 1);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] = owners.rank(columns_of(means, i)) == ranks_.own();
  std::vector<int> finer = firsts(ranks_, static_cast<int>(std::ranges::count(own, 1)));

  const std::vector<int> before = cells_->keep(own, layers_), in_order = own_in_order(means, own);
  std::vector<int> numbers(before.size() + asked.starts.size() - 1), number(own.size(), -1);
  Rows own_means;
  Questions questions(ranks_);
  for (std::size_t k = 0; k < in_order.size(); ++k) {
    const auto of_node = columns_of(means, static_cast<std::size_t>(in_order[k]));
    number[in_order[k]] = finer[ranks_.own()] + static_cast<int>(k);
    own_means.columns.insert(own_means.columns.end(), of_node.begin(), of_node.end());
    own_means.starts.push_back(counted(own_means.columns.size()));
  }
  for (std::size_t k = 0; k < before.size(); ++k) {
    const auto i = static_cast<std::size_t>(before[k]);
    if (own[i]) numbers[k] = number[i];
    else questions.ask(owners.rank(columns_of(means, i)), columns_of(means, i), k);
  }
  for (std::size_t a = 0; a + 1 < asked.starts.size(); ++a) questions.ask(owners.rank(columns_of(asked, a)), columns_of(asked, a), before.size() + a);
  const Buckets decided(end - begin, [&](auto&& put) {
    for (std::size_t i = 0; i < own.size(); ++i)
      if (own[i]) put(owners.decides(columns_of(means, i)) - begin, static_cast<int>(i));
  });
  questions.answer(
      [&](std::span<const int> of) {
        for (const int i : decided[owners.decides(of) - begin])
          if (std::ranges::equal(columns_of(means, static_cast<std::size_t>(i)), of)) return number[i];
        throw std::logic_error("refined share: a node that its rank has not");
      },
      [&](int at, int is) { numbers[at] = is; });
  std::vector<int> of_asked(numbers.begin() + std::ssize(before), numbers.end());
  numbers.resize(before.size());
  number_ = std::move(numbers);
  first_.insert(first_.begin(), std::move(finer)), means_.insert(means_.begin(), std::move(own_means));
  return of_asked;
}

OwnFunctions RefinedShare::functions(int level, const PrescribedBits& prescribed, const PrescribedBits& coarse_prescribed) const {
  const Rows& means = means_[level];
  const int begin = first_[level][ranks_.own()], all = (1 << dimension_) - 1;
  OwnFunctions own;
  own.starts = means.starts;
  own.component.reserve((means.starts.size() - 1) * static_cast<std::size_t>(dimension_)), own.means.reserve(means.columns.size());
  for (int i = 0; i + 1 < std::ssize(means.starts); ++i) {
    const int bits = bits_of(begin + i, prescribed);
    for (int k = 0; k < dimension_; ++k) own.component.push_back(bits >> k & 1 ? -1 : k);
  }
  for (const int p : means.columns) own.means.push_back(p * OwnFunctions::kComponents + (all & ~bits_of(p, coarse_prescribed)));
  return own;
}

std::vector<double> RefinedShare::at_nodes(const std::vector<double>& own) const {
  const std::vector<int>& first = first_.front();
  const auto d = static_cast<std::size_t>(dimension_);
  std::vector<double> all(number_.size() * d);
  std::vector<std::vector<int>> asked(static_cast<std::size_t>(ranks_.count())), places = asked;
  const auto copy = [&](int number, double* to) { std::copy_n(own.begin() + static_cast<std::ptrdiff_t>((number - first[ranks_.own()]) * d), d, to); };
  for (std::size_t k = 0; k < number_.size(); ++k) {
    const int rank = rank_with(first, number_[k]);
    if (rank == ranks_.own()) copy(number_[k], all.data() + k * d);
    else asked[rank].push_back(number_[k]), places[rank].push_back(static_cast<int>(k));
  }
  const auto of_others = ranks_.exchange(asked);
  std::vector<std::vector<double>> told(asked.size());
  for (std::size_t r = 0; r < told.size(); ++r) {
    told[r].resize(of_others[r].size() * d);
    for (std::size_t k = 0; k < of_others[r].size(); ++k) copy(of_others[r][k], told[r].data() + k * d);
  }
  told = ranks_.exchange(told);
  for (std::size_t r = 0; r < told.size(); ++r)
    for (std::size_t k = 0; k < places[r].size(); ++k) std::copy_n(told[r].begin() + static_cast<std::ptrdiff_t>(k * d), d, all.begin() + static_cast<std::ptrdiff_t>(places[r][k] * d));
  return all;
}

RefinedShare::Assembled RefinedShare::assemble(const PrescribedBits& prescribed) {
  std::vector<char> fixed;
  std::vector<int> slot;
  for (const int node : number_) {
    const int bits = bits_of(node, prescribed);
    for (int k = 0; k < dimension_; ++k) {
      fixed.push_back(static_cast<char>(bits >> k & 1));
      if (!fixed.back()) slot.push_back(node * dimension_ + k);
    }
  }
  const algebra::Refinable::Assembled all = cells_->assemble(fixed);
  const int begin = first_.front()[ranks_.own()], count = first_.front()[ranks_.own() + 1] - begin;
  std::vector<double> load(all.load.empty() ? 0 : static_cast<std::size_t>(count) * dimension_);
  for (std::size_t k = 0; k < all.load.size(); ++k)
    if (const int row = slot[k] - begin * dimension_; row >= 0 && row < std::ssize(load)) load[row] = all.load[k];
  return {own_rows(all.lower, slot, dimension_, begin, count), std::move(load)};
}

}  // namespace dotyk::multigrid

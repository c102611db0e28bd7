#include "multigrid/processes/ranks.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <numeric>

#include "base/counted.hpp"

namespace dotyk::multigrid {

Ranks::Ranks(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm, &own_);
  MPI_Comm_size(comm, &count_);
}

bool Ranks::all(bool own) const {
  int result = own;
  if (!alone()) MPI_Allreduce(MPI_IN_PLACE, &result, 1, MPI_INT, MPI_MIN, comm_);
  return result != 0;
}

double Ranks::sum(double own) const {
  if (!alone()) MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return own;
}

std::array<double, 2> Ranks::sum(std::array<double, 2> own) const {
  if (!alone()) MPI_Allreduce(MPI_IN_PLACE, own.data(), 2, MPI_DOUBLE, MPI_SUM, comm_);
  return own;
}

double Ranks::greatest(double own) const {
  if (!alone()) MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return own;
}

int Ranks::before(int own) const {
  int up_to = own;
  if (!alone()) MPI_Scan(&own, &up_to, 1, MPI_INT, MPI_SUM, comm_);
  return up_to - own;
}

std::vector<int> Ranks::gather(int own) const {
  std::vector<int> all(static_cast<std::size_t>(count_), own);
  if (!alone()) MPI_Allgather(&own, 1, MPI_INT, all.data(), 1, MPI_INT, comm_);
  return all;
}

namespace {

constexpr int kTag = 1, kExchange = 2;

template <class Number>
void gather_numbers(const Ranks& ranks, const Number* own, const std::vector<int>& counts, Number* all, MPI_Datatype type) {
  counted(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));  // as the last of these
  std::vector<int> starts;
  std::exclusive_scan(counts.begin(), counts.end(), std::back_inserter(starts), 0);
  MPI_Allgatherv(own, counts[ranks.own()], type, all, counts.data(), starts.data(), type, ranks.comm());
}

template <class Number>
std::vector<Number> gather_numbers(const Ranks& ranks, const std::vector<Number>& own, MPI_Datatype type) {
  const std::vector<int> counts = ranks.gather(counted(own.size()));
  std::vector<Number> all(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  gather_numbers(ranks, own.data(), counts, all.data(), type);
  return all;
}

/// Between neighbours alone: few of many ranks.
template <class Number>
void exchange_numbers(const Ranks& ranks, const std::vector<std::vector<Number>>& to, const std::vector<int>& counts, MPI_Datatype type, const auto& place) {
  std::vector<MPI_Request> requests;
  for (int r = 0; r < ranks.count(); ++r)
    if (counts[r] > 0) MPI_Irecv(place(r), counts[r], type, r, kExchange, ranks.comm(), &requests.emplace_back());
  for (int r = 0; r < ranks.count(); ++r)
    if (!to[r].empty()) MPI_Isend(to[r].data(), counted(to[r].size()), type, r, kExchange, ranks.comm(), &requests.emplace_back());
  MPI_Waitall(counted(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

template <class Number>
std::vector<std::vector<Number>> exchange_numbers(const Ranks& ranks, const std::vector<std::vector<Number>>& to, MPI_Datatype type) {
  std::vector<int> sent, counts(to.size(), 0);
  for (const auto& numbers : to) sent.push_back(counted(numbers.size()));
  MPI_Alltoall(sent.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, ranks.comm());
  std::vector<std::vector<Number>> from(to.size());
  for (std::size_t r = 0; r < from.size(); ++r) from[r].resize(static_cast<std::size_t>(counts[r]));
  exchange_numbers(ranks, to, counts, type, [&](int r) { return from[r].data(); });
  return from;
}

template <class Number>
void send_numbers(MPI_Comm comm, int to, const std::vector<Number>& numbers, MPI_Datatype type) {
  MPI_Send(numbers.data(), counted(numbers.size()), type, to, kTag, comm);
}

template <class Number>
void receive_numbers(MPI_Comm comm, int from, std::vector<Number>& numbers, MPI_Datatype type) {
  MPI_Status status;
  int count = 0;
  MPI_Probe(from, kTag, comm, &status);
  MPI_Get_count(&status, type, &count);
  numbers.resize(static_cast<std::size_t>(count));
  MPI_Recv(numbers.data(), count, type, from, kTag, comm, MPI_STATUS_IGNORE);
}

}  // namespace

std::vector<int> Ranks::gather(const std::vector<int>& own) const { return gather_numbers(*this, own, MPI_INT); }
std::vector<double> Ranks::gather(const std::vector<double>& own) const { return gather_numbers(*this, own, MPI_DOUBLE); }
void Ranks::gather(const double* own, const std::vector<int>& counts, double* all) const { gather_numbers(*this, own, counts, all, MPI_DOUBLE); }

std::vector<std::vector<int>> Ranks::exchange(const std::vector<std::vector<int>>& to) const { return exchange_numbers(*this, to, MPI_INT); }
std::vector<std::vector<double>> Ranks::exchange(const std::vector<std::vector<double>>& to) const { return exchange_numbers(*this, to, MPI_DOUBLE); }

void Ranks::exchange(const std::vector<std::vector<double>>& to, const std::vector<int>& counts, std::vector<double>& from) const {
  std::vector<std::size_t> starts{0};
  for (const int count : counts) starts.push_back(starts.back() + static_cast<std::size_t>(count));
  exchange_numbers(*this, to, counts, MPI_DOUBLE, [&](int r) { return from.data() + starts[r]; });
}

void Ranks::send(int to, const std::vector<int>& numbers) const { send_numbers(comm_, to, numbers, MPI_INT); }
void Ranks::send(int to, const std::vector<double>& numbers) const { send_numbers(comm_, to, numbers, MPI_DOUBLE); }
void Ranks::receive(int from, std::vector<int>& numbers) const { receive_numbers(comm_, from, numbers, MPI_INT); }
void Ranks::receive(int from, std::vector<double>& numbers) const { receive_numbers(comm_, from, numbers, MPI_DOUBLE); }

void Ranks::abort(const std::string& reason) const {
  std::fprintf(stderr, "dotyk: rank %d of %d: %s; the run ends on all ranks\n", own_, count_, reason.c_str());
  std::fflush(stderr);
  std::signal(SIGALRM, SIG_DFL);  // should MPI wait, as without memory it may: a rank's death ends the others
  sigset_t alarms;
  sigemptyset(&alarms);
  sigaddset(&alarms, SIGALRM);
  pthread_sigmask(SIG_UNBLOCK, &alarms, nullptr);
  alarm(2);
  MPI_Abort(comm_, 1);
  _exit(1);
}

int rank_with(const std::vector<int>& first, int number) { return static_cast<int>(std::ranges::upper_bound(first, number) - first.begin()) - 1; }

}  // namespace dotyk::multigrid

#include "multigrid/ranks.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>

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

double Ranks::greatest(double own) const {
  if (!alone()) MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return own;
}

namespace {

constexpr int kTag = 1;

template <class Number>
void send_numbers(MPI_Comm comm, int to, const std::vector<Number>& numbers, MPI_Datatype type) {
  MPI_Send(numbers.data(), static_cast<int>(numbers.size()), type, to, kTag, comm);
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

}  // namespace dotyk::multigrid

// The processes that share the work on a hierarchy, by MPI.
#pragma once

#include <mpi.h>

#include <array>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace dotyk::multigrid {

/// With fewer unknowns for each rank, messages take longer than the work that they share out.
constexpr double kFewestUnknowns = 1000;

/// Processes of one communicator, counted from 0. Functions of all of them together ("collective") must be called by all, in the same order.
class Ranks {
 public:
  explicit Ranks(MPI_Comm comm);

  MPI_Comm comm() const { return comm_; }
  int own() const { return own_; }
  int count() const { return count_; }
  bool alone() const { return count_ == 1; }

  bool all(bool own) const;           ///< collective
  double sum(double own) const;       ///< collective
  double greatest(double own) const;  ///< collective
  std::array<double, 2> sum(std::array<double, 2> own) const;  ///< of each of both; collective

  int before(int own) const;               ///< the sum over the ranks before this one; collective
  std::vector<int> gather(int own) const;  ///< by rank; collective
  /// Joins the lists of all ranks into one, in the order of the ranks. Collective.
  std::vector<int> gather(const std::vector<int>& own) const;
  std::vector<double> gather(const std::vector<double>& own) const;
  /// The same where it is known how many each rank has. Collective.
  void gather(const double* own, const std::vector<int>& counts, double* all) const;

  /// Sends `to` each rank its numbers and returns what came, by rank. Collective.
  std::vector<std::vector<int>> exchange(const std::vector<std::vector<int>>& to) const;
  std::vector<std::vector<double>> exchange(const std::vector<std::vector<double>>& to) const;
  /// The same where it is known how many numbers come from each rank; they are put into `from`, one rank after the other.
  void exchange(const std::vector<std::vector<double>>& to, const std::vector<int>& counts, std::vector<double>& from) const;

  void send(int to, const std::vector<int>& numbers) const;
  void send(int to, const std::vector<double>& numbers) const;
  /// Takes what was sent, in the order in which it was.
  void receive(int from, std::vector<int>& numbers) const;
  void receive(int from, std::vector<double>& numbers) const;
  template <class Number>
  std::vector<Number> received(int from) const {
    std::vector<Number> numbers;
    receive(from, numbers);
    return numbers;
  }

  /// Ends all of them with one message and status 1.
  [[noreturn]] void abort(const std::string& reason) const;
  /// Runs work that is collective. With several ranks an exception on one of them ends all: the others would wait for it for ever.
  template <class Work>
  auto together(const Work& work) const {
    if (alone()) return work();
    try {
      return work();
    } catch (const std::bad_alloc&) {
      abort("out of memory");
    } catch (const std::exception& error) {
      abort(error.what());
    }
  }

 private:
  MPI_Comm comm_;
  int own_ = 0, count_ = 1;
};

/// The rank that owns a number. `first`: the first number of each rank, ascending; the count of all may follow.
int rank_with(const std::vector<int>& first, int number);

}  // namespace dotyk::multigrid

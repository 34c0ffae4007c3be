#pragma once

#include <Eigen/Core>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

/// Distributes the units of a map (units_of()) by their numbers. It is on rank 0, and a thread of
/// it answers the requests of the other ranks. Each rank requests the next unit when it has
/// computed one. Waiting ranks sleep, so that other processes can use their cores.
class Dispatcher {
 public:
  /// Begins to answer. Requires MPI_THREAD_MULTIPLE.
  explicit Dispatcher(const std::vector<Eigen::Index>& units);
  /// Waits until every other rank has been answered that no unit is left.
  ~Dispatcher();
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// Returns the next unit for rank 0 itself; none if no unit is left.
  std::optional<Eigen::Index> next();
  /// The fraction of all units that has been distributed.
  double fraction();

 private:
  void answer_requests();

  std::mutex taking_;
  std::deque<Eigen::Index> left_;
  std::size_t all_;
  std::thread thread_;
};

/// Requests the next unit from the dispatcher on rank 0; for the other ranks.
std::optional<Eigen::Index> ask_for_unit();

/// Waits until every rank has called this, and returns the largest of their values.
int largest_of_all(int value);

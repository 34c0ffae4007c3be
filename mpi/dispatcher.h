#pragma once

#include <Eigen/Core>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

/// Hands out the units of a map (units_of()) by their numbers: on rank 0, whose thread answers the
/// requests of the others. Each rank asks for the next unit when it has computed one. Waiting ranks
/// sleep, so that a core can be another's.
class Dispatcher {
 public:
  /// Begins to answer. Requires MPI_THREAD_MULTIPLE.
  explicit Dispatcher(const std::vector<Eigen::Index>& units);
  /// Ends when every other rank has been answered that nothing is left.
  ~Dispatcher();
  Dispatcher(const Dispatcher&) = delete;
  Dispatcher& operator=(const Dispatcher&) = delete;

  /// The next unit, for rank 0 itself; none when nothing is left.
  std::optional<Eigen::Index> next();
  /// The fraction of all units that was handed out.
  double fraction();

 private:
  void answer_requests();

  std::mutex taking_;
  std::deque<Eigen::Index> left_;
  std::size_t all_;
  std::thread thread_;
};

/// The next unit of the dispatcher on rank 0, for the other ranks.
std::optional<Eigen::Index> ask_for_unit();

/// Waits until every rank is here, and returns the largest of their values.
int largest_of_all(int value);

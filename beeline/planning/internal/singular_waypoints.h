#pragma once

#include <functional>
#include <map>

#include <beeline/planning/internal/track_path.h>

namespace beeline::internal {

/// Whether the task's Jacobian at q has lost rank, or nearly so.
bool is_near_singular(const Arm& arm, const Task& task, const Configuration& q);

/// The limits, without bounds for periodic coordinates (representative.h).
Bounds bounds_without_turns(const Arm& arm);

/// The continuation of branches at waypoints where the arm is singular.
///
/// At such a waypoint the Jacobian does not determine how a branch continues: several branches
/// meet, or a self-motion connects infinitely many configurations, of which only a few continue
/// along the path. At a pose inside the next segment the arm is regular in general, and inverse
/// kinematics gives all branches. The branches that can be tracked back to the waypoint are its
/// departures.
class SingularWaypoints {
 public:
  /// Keeps references to the members of the search.
  explicit SingularWaypoints(const BranchSearch& search) : search_(search) {}

  using Accept = std::function<bool(const Branch&)>;

  /// Tracks a branch again from its singular waypoints, by depth-first search over their
  /// departures, beginning with the waypoint of segment `first`. Returns whether it found a
  /// complete branch that `accept` accepts. `branch` becomes this branch, otherwise the one that
  /// reaches farthest.
  bool complete(Branch& branch, std::size_t first, const Accept& accept);

  /// Tracks the path along each departure from its beginning.
  std::vector<Branch> branches_from_beginning();

 private:
  /// A waypoint, and its departures that continue the branch's configuration there.
  struct Choice {
    std::size_t segment = 0;  ///< after the waypoint
    std::vector<TrackedSegment> departures;
    std::size_t next = 0;  ///< to be tried
  };

  const std::vector<TrackedSegment>& departures(std::size_t segment);
  std::vector<TrackedSegment> departures_from(std::size_t segment, const Configuration& q);
  const TrackedSegment* next_departure(const Branch& branch, std::size_t first,
                                       std::vector<Choice>& choices);

  BranchSearch search_;
  std::map<std::size_t, std::vector<TrackedSegment>> departures_;  ///< of each segment asked for
};

}  // namespace beeline::internal

#pragma once

#include <optional>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/task.h>
#include <beeline/planning/internal/tool_boxes.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// The larger part of a deviation, as a multiple of the deviation of the blend of a move.
double blend_distance(const Move& move, const Deviation& away);

/// The deviation of joint i from the waypoint of a move in its blend, rad or m.
double allowed_in_blend(const Arm& arm, const Move& move, int i);

/// The distance of a configuration from the waypoint of a move, as a multiple of the deviation of
/// its blend: the larger one of position and orientation of the tool and, if the waypoint is a
/// configuration, of each joint.
double blend_distance(const Arm& arm, const Task& task, const Move& move, const Pose& waypoint,
                      const Configuration& q, const Pose& tool);

/// A passage of the motion near a waypoint: a local minimum of its distance.
struct Passage {
  double at = 0;  ///< number of samples before it, with a fraction of the interval after them

  /// The last sample before it and the first after it; both are the sample at which it is.
  std::size_t before() const;
  std::size_t after() const;
  std::size_t nearest() const;  ///< the nearer of both in time
};

/// The nearest sample of a stay near a waypoint, and the least distance of the motion next to it,
/// as a multiple of the deviation of a blend.
struct NearestSample {
  std::size_t sample = 0;
  double distance = 0;
};

/// Finds the passages of a trajectory near the waypoints of blends with joint moves.
class WaypointPassages {
 public:
  /// `tool` has the pose of the tool at each sample. All arguments must outlive the object.
  WaypointPassages(const Arm& arm, const Trajectory& trajectory, const Task& task,
                   const std::vector<Pose>& tool, BudgetMeter& budget);

  /// Returns the first passages from `first` on, a number of samples with a fraction of an
  /// interval, that are within the deviation of the blend of a move, in the order of time: at most
  /// `most`. Fewer if the budget ends the search.
  std::vector<Passage> passages(const Move& move, double first, std::size_t most) const;

  /// Returns the nearest sample of the first stay from `first` on within the deviation of the blend
  /// of a move.
  std::optional<NearestSample> nearest(const Move& move, std::size_t first) const;

  /// The distance of sample k from the waypoint of a move, as a multiple of the deviation of its
  /// blend.
  double distance(const Move& move, std::size_t k) const;

  /// Whether the tool at sample k is within the deviation of a blend from its waypoint.
  bool is_near(const Pose& waypoint, const Deviation& blend, std::size_t k) const;

  /// Returns the first such sample from `first` on. The number of samples if there is none, or the
  /// budget ends the search.
  std::size_t next_near(const Pose& waypoint, const Deviation& blend, std::size_t first) const;

 private:
  double distance_at(const Move& move, const Pose& waypoint, double at) const;
  bool joints_may_be_within(const Move& move, std::size_t k) const;
  bool may_be_within(const Move& move, std::size_t k, double distance) const;
  Passage refined(const Move& move, const Pose& waypoint, std::size_t k, double first,
                  double& distance) const;

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Task& task_;
  const std::vector<Pose>& tool_;
  BudgetMeter& budget_;
  ToolBoxes boxes_;
};

}  // namespace beeline::internal

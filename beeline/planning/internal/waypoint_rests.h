#pragma once

#include <optional>
#include <vector>

#include <beeline/kinematics/task.h>
#include <beeline/planning/internal/box_blocks.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// Finds the rests of a trajectory and the waypoints at which they are.
class WaypointRests {
 public:
  /// All arguments except the task must outlive the object.
  WaypointRests(const Arm& arm, const Trajectory& trajectory, const Task& task,
                const Deviation& tolerance);

  /// The pose of the tool at each sample.
  const std::vector<Pose>& tool() const { return tool_; }

  /// The distance of a pose of the tool, or of sample k, from a pose or from the waypoint of a
  /// move, as a fraction of the tolerance.
  double offset(const Pose& goal, const Pose& tool) const;
  double offset(const Pose& goal, std::size_t k) const { return offset(goal, tool_[k]); }
  double offset(const Move& move, std::size_t k) const;

  /// Whether the joints are at rest at sample k, to the tolerance of first_joint_fault() for the
  /// ends, which it checks itself.
  bool rests_at(std::size_t k) const { return rests_[k]; }

  /// Whether the joints rest from sample k to the next, at the waypoint of a move that ends at
  /// sample `at`.
  bool rests_after(std::size_t k, const Move& move, std::size_t at) const;

  /// Returns the samples from `first` on at which the arm is at rest within tolerance of a move's
  /// waypoint; of consecutive samples of one rest it returns the nearest. Samples at the waypoint
  /// to a thousandth of the tolerance come first, because the arm may rest before at other
  /// waypoints within the tolerance. The others follow. Both groups are in the order of time.
  std::vector<std::size_t> rests(const Move& move, std::size_t first) const;

  /// Returns the sample nearest to a move's waypoint, of the first consecutive samples from `first`
  /// on that are within tolerance of it, at rest or not.
  std::optional<std::size_t> passes(const Move& move, std::size_t first) const;

 private:
  /// Consecutive samples of one rest.
  struct Rest {
    std::size_t first = 0, last = 0;
  };

  bool is_slow(std::size_t k) const;
  bool rests_between(std::size_t k) const;
  std::vector<Rest> all_rests() const;
  std::size_t next_rest(const Move& move, std::size_t first) const;

  const Arm& arm_;
  const Trajectory& trajectory_;
  Task task_;
  Deviation tolerance_;
  std::vector<Limits> limits_;    ///< of motion_limits()
  std::vector<Pose> tool_ = {};   ///< at the samples
  std::vector<bool> rests_ = {};  ///< whether the joints are at rest at each sample
  std::vector<Rest> all_ = {};
  /// Of all rests: the positions of the tool, as far as the task constrains them, and the values of
  /// the first three joints.
  std::optional<BoxBlocks> tool_boxes_ = std::nullopt, joint_boxes_ = std::nullopt;
};

}  // namespace beeline::internal

#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_rests.h>

namespace beeline::internal {

/// Consecutive samples with the tool near a waypoint that a joint motion blends over.
struct NearSamples {
  std::size_t last = 0;
  std::size_t nearest = 0;  ///< of them, the first nearest to the waypoint
};

/// What is verified of a trajectory at the waypoints of a program, and the result so far.
class ProgramChecks {
 public:
  /// Keeps references to the arm, the trajectory, the program and the budget.
  ProgramChecks(const Arm& arm, const Trajectory& trajectory, const Program& program,
                const VerifyOptions& options, BudgetMeter& budget);

 protected:
  bool fail(Fault fault, std::size_t k, Reason reason);

  /// Fails at a move.
  bool fail(Fault fault, std::size_t k, std::size_t move, Reason reason);

  Pose tool_at(std::size_t k) const { return forward_kinematics(arm_, trajectory_.positions[k]); }

  /// Checks that the arm is at rest where move i ends.
  bool check_stop(std::size_t i);

  bool fail_to_reach(std::size_t move);

  /// Checks the dwell of the move that ends at the last arrival, and sets `begin_` to its end. Time
  /// at rest that belongs to a dwell before does not count.
  bool check_dwell(std::size_t move);

  bool check_speed(std::size_t move, std::size_t from, std::size_t to,
                   const std::optional<double>& limit);

  /// Returns the sample before the samples from `from` to `at` that are within tolerance of the
  /// pose.
  std::size_t before_near(const Pose& pose, std::size_t from, std::size_t at) const;

  /// Returns the sample after the samples from `at` to `to` that are within tolerance of the pose.
  std::size_t after_near(const Pose& pose, std::size_t at, std::size_t to) const;

  /// Checks the speed of move i from sample `from` to `reached`, at the end of a segment which the
  /// tool passes to the next move; returns the sample from which that move's own limit holds. Which
  /// sample is the first of that move is only known to the tolerance.
  std::optional<std::size_t> check_passing(std::size_t i, const Segment& segment, std::size_t from,
                                           std::size_t reached, std::size_t end);

  /// Checks that the joints rest at the waypoint of the last move from `begin_` to the end.
  bool check_rest(std::size_t move);

  /// Returns the first samples from `from` on with the tool near the waypoint of move i: within
  /// nine tenths of the deviation that its blend allows.
  std::optional<NearSamples> near_waypoint(std::size_t i, std::size_t from) const;

  /// The part between the sample nearest to the waypoint of move i and the line beside it, which
  /// begins or ends there: after its end, or before its beginning, the line is followed within the
  /// tolerance, from the waypoint's half of it on.
  PassedWaypoint part_beside_line(std::size_t i, std::size_t nearest, const Line& line,
                                  bool begins);

  /// Checks that the tool is as near to the line in this part as the blend after the move allows,
  /// and keeps the larger limit of its speed; ends the move at the sample `end`.
  bool check_blend(const PassedWaypoint& passed, std::size_t end);

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Program& program_;
  VerifyOptions options_;
  BudgetMeter& budget_;
  Task task_;
  WaypointRests rests_;
  std::size_t begin_ = 0;  // the sample at which the next part begins
  double dwelled_until_ = -std::numeric_limits<double>::infinity();  // end of the last dwell, s
  Verification result_ = {};
};

}  // namespace beeline::internal

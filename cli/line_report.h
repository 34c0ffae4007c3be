#pragma once

#include <optional>

#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>

#include "motion_report.h"
#include "result_files.h"
#include "scene_argument.h"
#include "work_frame.h"

namespace beeline::command {

/// The report of `line`, by any method.
struct LineReport {
  std::string method = {};
  bool planned = true;  ///< by method exact; else simulated under control
  std::size_t waypoints = 0;
  MotionStatus status = MotionStatus::not_converged;
  Reason reason = {};
  std::vector<std::string> options = {};          ///< that the reason means
  PositionFrame positions = PositionFrame::only;  ///< of the reason's positions
  /// Up to which a plan follows the path; a program has several.
  std::optional<double> path_parameter = std::nullopt;
  Trajectory trajectory = {};
  PathDeviation deviation = {};
  LimitUsage limits = {};
  std::optional<Recovery> recovery = {};           ///< when planned
  StartJump start_jump = {};                       ///< of a controller's motion
  double limit_margin = 0, inverse_condition = 0;  ///< when planned
  std::vector<NearbyPath> nearby = {};
  std::optional<std::vector<Branch>> branches = {};         ///< with --branches
  int steps = 0;                                            ///< of a controller
  double overshoot = 0;                                     ///< fraction of a line
  std::optional<FollowedPath> path = std::nullopt;          ///< when reached
  Program program = {};                                     ///< without moves: poses
  std::vector<PlannedMove> moves = {};                      ///< of the program, when reached
  Ending search_ending = Ending::complete;                  ///< see ProgramMotion::search_ending
  std::size_t failed = 0;                                   ///< its move that is not possible
  std::optional<ClearanceReport> clearance = std::nullopt;  ///< with --scene or --self
  std::vector<BlockedBranch> blocked = {};                  ///< see PathMotion::blocked
};

/// The sentence of the reason, with the options that it means and the frame of its positions.
std::string reason_text(const LineReport& report);

std::string report_text(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files);
Json report_document(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                     const ResultFiles& files);

}  // namespace beeline::command

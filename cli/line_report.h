#pragma once

#include <optional>

#include <beeline/planning/move_along.h>
#include <beeline/planning/program.h>

#include "motion_report.h"
#include "result_files.h"

/// The report of `line`, by any method.
struct LineReport {
  std::string method = {};
  std::size_t waypoints = 0;
  beeline::MotionStatus status = beeline::MotionStatus::not_converged;
  beeline::Reason reason = {};
  std::string note = {};  ///< after the reason: options and frames that it means
  /// Of method exact, up to which the plan follows the path; a program has several.
  std::optional<double> path_parameter = std::nullopt;
  beeline::Trajectory trajectory = {};
  beeline::PathDeviation deviation = {};
  beeline::LimitUsage limits = {};  ///< of method exact, as the margins are
  double limit_margin = 0, inverse_condition = 0;
  std::vector<beeline::NearbyPath> nearby = {};
  std::optional<std::vector<beeline::Branch>> branches = {};  ///< with --branches
  int steps = 0;                                              ///< of a controller
  double overshoot = 0;                                       ///< fraction of a line
  std::optional<beeline::FollowedPath> path = std::nullopt;   ///< when reached
  beeline::Program program = {};                              ///< without moves: poses
  std::vector<beeline::PlannedMove> moves = {};               ///< of the program, when reached
  std::size_t failed = 0;                                     ///< its move that is not possible
};

std::string report_text(const beeline::Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files);
Json report_document(const beeline::Arm& arm, const LineReport& report, const UnitArgument& unit,
                     const ResultFiles& files);

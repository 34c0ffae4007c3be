#pragma once

#include <optional>

#include <beeline/planning/move_along.h>

#include "results.h"

/// What is reported, whichever way the line was followed.
struct LineReport {
  std::string method;
  std::size_t waypoints = 0;
  beeline::MotionStatus status = beeline::MotionStatus::not_converged;
  std::string reason;
  beeline::Trajectory trajectory;
  beeline::PathDeviation deviation;
  beeline::LimitUsage limits = {};  ///< of method exact, as the margins are
  double limit_margin = 0, dexterity = 0;
  std::vector<beeline::NearbyPath> nearby = {};
  std::optional<std::vector<beeline::Branch>> branches = {};  ///< when they were asked for
  int steps = 0;                                              ///< of a controller
  double overshoot = 0;
  std::optional<beeline::FollowedPath> path = std::nullopt;  ///< when reached
};

void print_report(const beeline::Arm& arm, const LineReport& report, const UnitArgument& unit,
                  const ResultFiles& files);
OrderedJson json_report(const beeline::Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files);

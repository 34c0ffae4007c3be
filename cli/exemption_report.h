#pragma once

#include <string>

#include <beeline/doctor/diagnosis.h>
#include <beeline/io/text/json.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "scene_argument.h"

namespace beeline::command {

/// What is found about the pairs of bodies that --srdf and the scenes exempt.
struct ExemptionReport {
  std::string text = {};  ///< empty: no file was given
  Json document = {};
  std::int64_t collisions = 0;  ///< number of exempted pairs that collide at some configurations
  std::string ending = {};      ///< name of the ending of a search that its budget ended

  /// Returns the verdict on the numbers of a model with this one.
  std::string with_verdict(const std::string& verdict, bool suspicious) const;
  /// Returns what is said of a search that its budget ended.
  std::string unfinished() const;
};

/// Examines the exempted pairs, see examine_exemptions(). Warns if the shapes cannot be read.
ExemptionReport report_on_exemptions(const ArmArgument& arm_argument, const Arm& arm,
                                     SceneArgument scene, const UnitArgument& unit,
                                     const BudgetArgument& budget);

}  // namespace beeline::command

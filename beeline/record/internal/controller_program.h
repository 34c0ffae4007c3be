#pragma once

#include <string>
#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// What the programs for controllers of one maker are written from.
struct ProgramSource {
  const Trajectory& samples;                 ///< of six revolute joints, from time 0
  const std::vector<std::string>& comments;  ///< lines of ASCII
  const std::string& name;                   ///< of the program
};

/// A program of URScript: the arm moves to the first sample, asks first when it is far from it, and
/// follows the samples, which are `period` seconds apart, by servoj().
std::string urscript_program(const ProgramSource& source, double period);

/// A module of RAPID, with one MoveAbsJ for each sample in the time to it. Throws Error for a name
/// that is no identifier.
std::string rapid_program(const ProgramSource& source);

/// A program of KRL, with one PTP for each sample. Throws Error for a name that is no identifier.
std::string krl_program(const ProgramSource& source);

}  // namespace beeline::internal

#pragma once

#include <numbers>
#include <string>
#include <vector>

#include <beeline/io/internal/program_frames.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The content of a program for controllers of one maker.
struct ProgramSource {
  const Trajectory& samples;                 ///< of six revolute joints, from time 0
  const std::vector<std::string>& comments;  ///< lines of ASCII
  const std::string& name;                   ///< of the program
  ProgramFrames frames = {};                 ///< its tool is stated unless it is the flange
};

/// Each line after the prefix of a comment.
std::string commented(const std::vector<std::string>& lines, const char* prefix);

constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// fixed_point() without a sign before zero, and numbers in it separated by commas.
std::string plain(double value, int decimals);
std::string listed_numbers(const Configuration& values, int decimals);

/// Radians as a list in brackets, to 1e-9.
std::string radians_of(const Configuration& q);

/// Throws Error for a name that is no identifier of the language, is too long or has a meaning in
/// it.
void check_rapid_name(const std::string& name);
void check_krl_name(const std::string& name);

/// A configuration as jointtarget of RAPID, and as AXIS of KRL.
std::string rapid_axes(const Configuration& q);
std::string krl_axes(const Configuration& q);

/// Returns statements of URScript that move the arm to `first`, after a question if it is far away,
/// and halt the program if the arm does not arrive.
std::string urscript_approach(const Configuration& first);

/// A program of URScript: the arm moves to the first sample, asks first when it is far from it, and
/// follows the samples, which are `period` seconds apart, by servoj().
std::string urscript_program(const ProgramSource& source, double period);

/// A module of RAPID, with one MoveAbsJ for each sample in the time to it. Throws Error for a name
/// that is no identifier.
std::string rapid_program(const ProgramSource& source);

/// A program of KRL, with one PTP for each sample. Throws Error for a name that is no identifier.
std::string krl_program(const ProgramSource& source);

}  // namespace beeline::internal

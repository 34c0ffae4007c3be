#pragma once

#include <optional>

#include <beeline/model/arm.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// The largest length of an arm, in metres, at most 1: of its offsets, base, tool, and of the
/// moments and pitches of its screws. Lengths below zero_length times it are taken as zero.
double length_unit(const Arm& arm);
constexpr double zero_length = 1e-12;

/// Whether two joints are equal within `tolerance` (rad; lengths zero_length, both times `unit`).
bool same_joint(const Joint& a, const Joint& b, double tolerance, double unit);

/// Returns the Denavit-Hartenberg row that gives the joint, or nothing if none does within
/// `tolerance` (rad; lengths zero_length, both times `unit`, see length_unit()).
std::optional<DhRow> dh_row(const Joint& joint, DhConvention convention, double tolerance,
                            double unit = 1);

}  // namespace beeline::internal

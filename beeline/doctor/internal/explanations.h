#pragma once

#include <optional>
#include <vector>

#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// The Denavit-Hartenberg rows of an arm whose link frames follow the convention.
using DhRows = std::vector<DhRow>;
std::optional<DhRows> own_dh_rows(const Arm& arm, DhConvention convention);

/// Returns the arm with other rows. Base, tool and names stay.
Arm with_rows(const Arm& arm, const DhRows& rows, DhConvention convention);

/// Explains B by A row by row, if both are tables of one convention with joints of equal kinds.
std::vector<Reconciliation> table_explanations(const Arm& a, const Arm& b, double tolerance);

/// Explains B by A joint by joint, from the frames of their links: origins, orientations, axes,
/// offsets and signs. Returns one explanation, or none if the numbers of joints differ.
std::vector<Reconciliation> frame_explanations(const Arm& a, const Arm& b, double tolerance);

/// Explains B by A from the joints' screw axes in space: mount, tool, offsets, signs and, if these
/// do not suffice, the dimensions between neighbouring axes. If mount or tool is a rotation about
/// the first or last axis, another explanation replaces it by an offset of that joint. Returns
/// nothing if the arms differ in the number or the kinds of their joints.
std::vector<Reconciliation> screw_explanations(const Arm& a, const Arm& b, double tolerance);

}  // namespace beeline::internal

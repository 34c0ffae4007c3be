#pragma once

#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/collision/scene.h>
#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The kind of a suspicious number in a model.
enum class FindingKind {
  length_unit,       ///< lengths that appear to be millimetres
  angle_unit,        ///< degrees instead of radians
  rounded_angle,     ///< a right angle written with few digits
  nearly_special,    ///< axes that are nearly, not exactly, parallel, perpendicular or concurrent
  coincident_axes,   ///< two neighbouring joints that move alike
  missing_axis,      ///< a joint of a URDF file without axis element
  axis_length,       ///< an axis that is not of unit length
  no_range,          ///< limits that leave no or nearly no range
  unknown_velocity,  ///< a velocity limit that is missing where other joints have one
  fault              ///< a fault of the file beside the chain, or text of it that is ignored
};
std::string name(FindingKind kind);

/// A suspicious number of a model.
struct Finding {
  FindingKind kind = FindingKind::length_unit;  ///< kind of the finding
  int joint = -1;           ///< joint index, from 0; -1: several joints, or the whole arm
  std::string place = {};   ///< place in the model, such as `joint 3 (elbow)` or `joints 2, 4, 5`
  std::string what = {};    ///< the value, and why it is suspicious
  std::string cost = {};    ///< computed effect of the value; empty if there is none
  std::string remedy = {};  ///< text that corrects the value
};

/// The suspicious numbers of a model.
struct Diagnosis {
  std::vector<Finding> findings;  ///< findings in the order of the checks

  /// Returns whether nothing is suspicious.
  explicit operator bool() const { return findings.empty(); }
};

/// Searches an arm for numbers that are likely mistakes: units; rounded right angles; axes that
/// nearly have a closed form of inverse kinematics, with the method that is lost; joints that move
/// alike; limits. Does not report what may be intentional.
Diagnosis diagnose(const Arm& arm);

/// Diagnoses an arm as read_arm() reads it, and checks its file: a missing axis element, an axis
/// not of unit length, angles in another unit than the file declares, faults beside the chain, and
/// elements and attributes that are ignored.
/// Throws Error and FileError as read_arm() does.
Diagnosis diagnose(const std::string& text, const ChainEnds& ends = {});

/// Returns the faults of a URDF file, on every chain, in the order of its lines: up to 100, and the
/// number of the others. It needs no chain, so that all faults are reported for a file that
/// read_arm() refuses for its first fault. Files of other formats have no faults. Throws FileError
/// for a file that cannot be read or is not URDF.
std::vector<Finding> file_faults(const std::string& path);

/// What is known of a pair of bodies that may touch.
enum class ExemptionStatus {
  never_close,      ///< it is proved that they never touch within the position limits
  collides,         ///< they collide at some configurations: motions into them would be accepted
  always_collides,  ///< they collide at all configurations that were tried
  no_collision,     ///< the search found no collision, which proves nothing
  not_checked,      ///< they share a joint or never move relative to each other
  time_limit,       ///< the budget ended the search before it found a collision
  cancelled,        ///< likewise
  work_limit,       ///< likewise
};
std::string name(ExemptionStatus status);

/// A pair of bodies that a file exempts from collision checks.
struct Exemption {
  NamedPair names;                                        ///< names of the two bodies
  ExemptionStatus status = ExemptionStatus::not_checked;  ///< what is known of the pair
  Configuration q = {};  ///< the configuration with the deepest collision that was found (n,)
  double depth = 0;      ///< translation that would separate the bodies there, m
};

struct ExemptionOptions {
  int configurations = 200;  ///< number of random configurations that are tried for each pair
  Budget budget = {};        ///< of all pairs
};

/// Examines pairs of bodies that a file exempts: those that are proved never to touch are rightly
/// exempted, those that collide hide collisions. Tries random configurations within the position
/// limits, and from the nearest of them descends along the gradient of the distance. Names that are
/// neither of a link nor of an obstacle are left out; a pair that is given twice is examined once.
/// Throws Error as CollisionModel does, and for less than one configuration.
std::vector<Exemption> examine_exemptions(const Arm& arm, const std::vector<LinkShapes>& links,
                                          const Scene& scene, const std::vector<NamedPair>& pairs,
                                          const ExemptionOptions& options = {});

}  // namespace beeline

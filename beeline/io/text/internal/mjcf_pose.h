#pragma once

#include <string>

#include <beeline/io/text/internal/mjcf_attributes.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// The `<compiler>` of an MJCF file, as far as it concerns kinematics and shapes.
struct MjcfSettings {
  bool degrees = true;           ///< angles are in degrees, as by default
  bool autolimits = true;        ///< a joint with a range is limited
  std::string euler = "xyz";     ///< three axes; capitals are fixed ones
  std::string mesh_folder = {};  ///< relative to the folder of the model
  bool strip_path = false;       ///< names of meshes without their folders

  double radians(double angle) const;  ///< from the unit of the file
};

/// Reads it; of several the last one that gives an attribute counts, as in MuJoCo. Throws
/// FileError.
MjcfSettings mjcf_settings(const MjcfDocument& document);

/// Returns the pose of a body, a frame, a site or a geom in its parent: `pos` with one of `quat` (w
/// x y z, of any length), `axisangle`, `xyaxes`, `zaxis` and `euler`, or `fromto`. Throws
/// FileError.
Pose mjcf_pose(const MjcfAttributes& attributes, const MjcfSettings& settings);

/// The points of `fromto`, the first end and the second one, in the parent.
struct MjcfEnds {
  Vector3 from, to;
};
MjcfEnds mjcf_ends(const MjcfAttributes& attributes);

}  // namespace beeline::internal

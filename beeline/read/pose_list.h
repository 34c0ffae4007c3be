#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// The unit of angles in a text; the library itself uses radians only.
enum class AngleUnit { radians, degrees };

double to_radians(double angle, AngleUnit unit);

/// A pose as a text gives it.
struct WrittenPose {
  Pose pose;
  bool planar = false;   ///< given as x,y,theta
  double max_angle = 0;  ///< the angle that is largest by magnitude, radians; 0 with a quaternion
};

/// Poses of a CSV file. A text gives a pose in one of three forms, in metres and an AngleUnit:
///     x,y,theta     x,y,z,roll,pitch,yaw     x,y,z,qw,qx,qy,qz
/// The first is planar: a pose in the plane z = 0.
struct PoseList {
  std::vector<Pose> poses = {};  ///< at least one
  std::vector<int> lines = {};   ///< the line of the file of each pose
  bool planar = false;           ///< given as x,y,theta
  double max_angle = 0;          ///< the angle that is largest by magnitude, radians
};

/// Returns the names of the columns of the three forms.
const std::array<std::vector<std::string>, 3>& pose_forms();

/// Returns the pose given by 3, 6 or 7 numbers in the order of pose_forms(). Throws Error for any
/// other count and for a quaternion that is not of unit length.
Pose pose_of(std::span<const double> numbers, AngleUnit unit = AngleUnit::radians);

/// Reads a CSV file whose header names the columns of one form, in any order. Throws FileError for
/// a column that is missing or unknown, for a quaternion that is not of unit length, and for a pose
/// farther away than 1e100 m.
PoseList read_poses(const std::string& path, AngleUnit unit = AngleUnit::radians);
/// The same from a text; `path` names it in messages.
PoseList poses_from_csv(std::string_view text, const std::string& path,
                        AngleUnit unit = AngleUnit::radians);

/// Parses a pose from 3, 6 or 7 numbers separated by commas, as pose_of().
WrittenPose parse_pose(std::string_view text, AngleUnit unit = AngleUnit::radians);

}  // namespace beeline

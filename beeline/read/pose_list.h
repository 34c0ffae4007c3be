#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/pose/se3.h>
#include <beeline/read/numbers.h>

namespace beeline {

/// Poses are written in one of three forms, metres and `unit`:
///     x,y,theta     x,y,z,roll,pitch,yaw     x,y,z,qw,qx,qy,qz
/// The first is planar and becomes the pose in the plane z = 0.
struct PoseList {
  std::vector<Pose> poses;  ///< at least one
  std::vector<int> lines;   ///< the line of the file that each stands on
  bool planar = false;      ///< written as x,y,theta
};

/// The names of the three forms' columns, and the pose that so many numbers stand for, in that
/// order. Throws Error for a quaternion not of length 1.
const std::array<std::vector<std::string>, 3>& pose_forms();
Pose pose_of(std::span<const double> numbers, AngleUnit unit = AngleUnit::radians);

/// From a CSV file whose header names one form's columns, in any order.
/// Throws FileError for a column that is missing or unknown, and for a quaternion not of length 1.
PoseList read_poses(const std::string& path, AngleUnit unit = AngleUnit::radians);
PoseList poses_from_csv(std::string_view text, const std::string& path,
                        AngleUnit unit = AngleUnit::radians);

struct WrittenPose {
  Pose pose;
  bool planar = false;  ///< written as x,y,theta
};

/// From a list of 3, 6 or 7 numbers in the order above. Throws Error for any other count.
WrittenPose parse_pose(std::string_view text, AngleUnit unit = AngleUnit::radians);

}  // namespace beeline

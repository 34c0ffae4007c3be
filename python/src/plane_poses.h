#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/model/arm.h>

#include "value.h"

namespace beeline::python {

/// The annotation and the documentation of a pose of an arm.
inline constexpr const char* arm_pose_like = "Pose2 | numpy.typing.ArrayLike";
inline constexpr const char* arm_pose_doc =
    "Pose (4, 4); of a planar arm also [x, y, theta] or a Pose2.";
/// The same of a frame on the arm or in its cell, such as a tool.
inline constexpr const char* arm_frame_doc =
    "Pose (4, 4), or the position [x, y, z] of a frame that is not turned. Of a planar arm three "
    "numbers are [x, y, theta], and it may be a Pose2.";
inline constexpr const char* arm_poses_like =
    "collections.abc.Sequence[Pose2] | numpy.typing.ArrayLike";
inline constexpr const char* arm_poses_doc =
    "Poses world_T_tool, (N, 4, 4) or a list of them; of a planar arm also (N, 3), x, y, theta "
    "each, or Pose2.";

/// The plane in which poses of an arm lie that are given by x, y and theta, if the arm is planar.
class PosePlane {
 public:
  /// The plane of the tool: for poses world_T_tool.
  explicit PosePlane(const Arm& arm);
  /// The pose of a frame on the arm, such as a tool: in the plane z = 0 if the arm is planar; else
  /// three numbers are its position.
  static Pose frame(const Arm& arm, nb::handle value, const char* name);

  /// The argument's pose. Throws Error, which names the argument, for what is none.
  Pose pose(nb::handle value, const char* name) const;
  /// Whether the argument is many poses, none included: an array of more dimensions than a pose, or
  /// a list of poses.
  bool many(nb::handle value) const;
  /// One pose or many.
  std::vector<Pose> poses(nb::handle value, const char* name) const;
  /// Whether an array of this shape has x, y and theta in its last dimension.
  bool planar_shape(std::span<const Index> shape) const {
    return height_ && !shape.empty() && shape.back() == 3;
  }
  /// The pose of x, y, theta, finite or not.
  Pose pose_of(const double* numbers) const;

 private:
  std::string arm_;
  std::optional<double> height_;  ///< none: the arm is not planar
};

/// Throws Error where rows x, y, theta may be a matrix of SE(2).
void check_rows(const InputArray& array);

}  // namespace beeline::python

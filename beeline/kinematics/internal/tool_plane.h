#pragma once

#include <cmath>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// The plane z = constant in which a planar arm moves its tool. The default task of a planar arm
/// ignores height and tilt, so poses outside the plane are refused unless a task is given.
class ToolPlane {
 public:
  /// Returns the plane in which poses of the arm must be; none if a task is given or the arm is not
  /// planar.
  static std::optional<ToolPlane> required(const Arm& arm, const std::optional<Task>& task);

  /// Whether a position is in the plane, to 1e-6 m.
  bool contains(const Vector3& position) const {
    return std::abs(position.z() - height_) < tolerance;
  }
  /// Whether a pose is in the plane: its origin to 1e-6 m, its z axis upright to 1e-6.
  bool contains(const Pose& pose) const {
    return contains(Vector3(pose.translation())) &&
           (pose.linear().col(2) - Vector3::UnitZ()).squaredNorm() < tolerance * tolerance;
  }

  /// Throws Error, which calls the pose `what`, for a pose that is not a rigid motion or is outside
  /// the plane. The argument of the latter is `task`.
  void check(const Pose& pose, const std::string& what = "the pose") const {
    if (!contains(pose)) refuse(pose, what);
  }

  std::size_t heap_bytes() const { return arm_.capacity(); }

  /// `WHAT is outside the plane z = 0 m of arm rrr; give x,y,theta`.
  std::string fault(const std::string& what) const;
  /// The error of the same fault, which also names the task that ignores height and tilt.
  Error error(const std::string& what) const;

 private:
  static constexpr double tolerance = 1e-6;  ///< metres, and of the unit vector z

  ToolPlane(double height, std::string arm) : height_(height), arm_(std::move(arm)) {}
  [[noreturn]] void refuse(const Pose& pose, const std::string& what) const;

  double height_;
  std::string arm_;
};

}  // namespace beeline::internal

#include "plane_poses.h"

#include <beeline/kinematics/forward.h>

#include "pose_fields.h"

namespace beeline::python {
namespace {

bool is_list(nb::handle value) {
  return nb::isinstance<nb::list>(value) || nb::isinstance<nb::tuple>(value);
}

/// Whether a list has poses as objects, not numbers or rows of them.
bool has_objects(nb::handle value) {
  if (!is_list(value) || nb::len(value) == 0) return false;
  const nb::object first = value[0];
  return !is_array(first) && !is_list(first) && !PyNumber_Check(first.ptr());
}

}  // namespace

PosePlane::PosePlane(const Arm& arm) : arm_(arm.name()) {
  if (arm.planar()) height_ = pose_in_plane(arm, {}).translation().z();
}

Pose PosePlane::frame(const Arm& arm, nb::handle value, const char* name) {
  PosePlane plane(arm);
  if (plane.height_) {
    plane.height_ = 0;
  } else if (is_array(value) || is_list(value)) {
    const InputArray array(value, name);
    if (array.dimensions() == 1 && array.shape()[0] == 3) {
      const Vector3 position(array.data()[0], array.data()[1], array.data()[2]);
      return checked_pose(make_pose(position, Rotation::Identity()), name);
    }
  }
  return plane.pose(value, name);
}

Pose PosePlane::pose_of(const double* numbers) const {
  return to_space(Pose2{numbers[0], numbers[1], numbers[2]}, *height_);
}

Pose PosePlane::pose(nb::handle value, const char* name) const {
  if (nb::isinstance<Pose2>(value)) {
    if (!height_) {
      throw Error(std::string(name) + ": a Pose2 is for planar arms; a pose of " + arm_ +
                  " is spatial");
    }
    return checked_pose(to_space(nb::cast<Pose2>(value), *height_), name);
  }
  const nb::object matrix = matrix_of(value);
  const InputArray array(matrix, name);
  const bool planar = array.dimensions() == 1 && planar_shape(array.shape());
  return planar ? checked_pose(pose_of(array.data()), name) : Value<Pose>::from(matrix, name);
}

std::vector<Pose> PosePlane::poses(nb::handle value, const char* name) const {
  if (nb::isinstance<Pose2>(value)) return {pose(value, name)};
  std::vector<Pose> poses;
  if (has_objects(value)) {
    for (nb::handle item : nb::borrow(value)) poses.push_back(pose(item, name));
    return poses;
  }
  if (!height_) return poses_from(value, name);
  const nb::object matrices = matrix_of(value);
  const InputArray array(matrices, name);
  if (array.dimensions() > 2 || !planar_shape(array.shape())) return poses_from(matrices, name);
  const double* last = array.data() + 6;
  if (array.rows(1) == 3 && last[0] == 0 && last[1] == 0 && last[2] == 1) {
    throw Error(std::string(name) + " may be a matrix of SE(2); give [x, y, theta] or a Pose2");
  }
  for (Index i = 0; i < array.rows(1); ++i) {
    poses.push_back(checked_pose(pose_of(array.data() + 3 * i), name));
  }
  return poses;
}

}  // namespace beeline::python

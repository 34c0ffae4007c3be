#include "plane_poses.h"

#include <beeline/kinematics/forward.h>

#include "pose_fields.h"

namespace beeline::python {
namespace {

/// Whether a list has poses as objects, not numbers or rows of them.
bool has_objects(nb::handle value) {
  if (!is_list(value) || nb::len(value) == 0) return false;
  const nb::object first = value[0];
  return !is_array(first) && !is_list(first) && !PyNumber_Check(first.ptr());
}

/// The number of dimensions of lists and arrays in one another, and the length of the last one. A
/// pose as an object is a matrix; numpy has 64 dimensions at most.
struct Form {
  int dimensions;
  Index last;
};

Form form_of(nb::handle value, int outer = 0) {
  if (is_array(value)) {
    const auto shape = python::shape_of(value);
    return {static_cast<int>(shape.size()), shape.empty() ? 0 : shape.back()};
  }
  if (!is_list(value)) return PyNumber_Check(value.ptr()) ? Form{0, 0} : Form{2, 4};
  const auto length = static_cast<Index>(nb::len(value));
  if (length == 0 || outer == 64) return {3, length};
  const nb::object first = value[0];
  const Form inner = form_of(first, outer + 1);
  return {inner.dimensions + 1, inner.dimensions == 0 ? length : inner.last};
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
  if (!is_array(value) && nb::isinstance<Pose2>(value)) {
    if (!height_) {
      throw Error(std::string(name) + ": a Pose2 is for planar arms; a pose of " + arm_ +
                  " is spatial");
    }
    return checked_pose(to_space(nb::cast<Pose2>(value), *height_), name);
  }
  const nb::object matrix = matrix_of(value);
  const InputArray array(matrix, name);
  const bool planar = array.dimensions() == 1 && planar_shape(array.shape());
  return checked_pose(planar ? pose_of(array.data()) : python::pose_of(array), name);
}

bool PosePlane::many(nb::handle value) const {
  const bool plain = is_array(value) || is_list(value);
  if (!plain && nb::isinstance<Pose2>(value)) return false;
  const Form form = plain ? form_of(value) : form_of(matrix_of(value));
  return form.dimensions > (height_ && form.last == 3 ? 1 : 2);
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
  check_rows(array);
  for (Index i = 0; i < array.rows(1); ++i) {
    poses.push_back(checked_pose(pose_of(array.data() + 3 * i), name));
  }
  return poses;
}

void check_rows(const InputArray& array) {
  if (array.dimensions() != 2 || array.rows(1) != 3) return;
  const double* last = array.data() + 6;
  if (last[0] != 0 || last[1] != 0 || last[2] != 1) return;
  throw Error(std::string(array.name()) +
              " may be a matrix of SE(2); give [x, y, theta] or a Pose2");
}

}  // namespace beeline::python

#pragma once

#include <beeline/batch/batch.h>
#include <beeline/kinematics/analytical_jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/kinematics/task.h>

#include "record.h"

namespace beeline::python {

template <>
inline std::vector<Frame> choices() {
  return {Frame::base, Frame::tool, Frame::space};
}

/// As frame_named(), which says what the names mean.
template <>
inline Error unknown_choice<Frame>(const char* /*argument*/, const std::string& name) {
  frame_named(name);  // throws
  return unknown_name("frame", name, {});
}

template <>
inline std::vector<PoseLayout> choices() {
  return {PoseLayout::matrix, PoseLayout::position_quaternion};
}
template <>
inline std::string spelling(PoseLayout layout) {
  return layout == PoseLayout::matrix ? "matrix" : "position_quaternion";
}

template <>
inline std::vector<OrientationCoordinates> choices() {
  using enum OrientationCoordinates;
  return {roll_pitch_yaw, quaternion, rotation_vector};
}

template <>
struct Fields<Deviation> {
  static constexpr const char* name = "Deviation";
  static constexpr const char* doc = "Norms of the linear and the angular part of a task error.";
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
  static constexpr auto all() {
    return std::tuple(field("position", &Deviation::position, "Metres."),
                      field("orientation", &Deviation::orientation, "Radians."));
  }
};

template <>
struct Fields<ManipulabilityMeasures> {
  static constexpr const char* name = "ManipulabilityMeasures";
  static constexpr const char* doc =
      "Measures of a Jacobian's distance from singularity (Lynch & Park, *Modern Robotics*, 2017,\n"
      "section 5.4).";
  static constexpr auto all() {
    return std::tuple(
        field("singular_values", &ManipulabilityMeasures::singular_values,
              "In decreasing order, min(rows, columns) of them."),
        field("manipulability", &ManipulabilityMeasures::manipulability,
              "sqrt(det(J J^T)), the product of the singular values; 0 with fewer columns than "
              "rows (Yoshikawa, 1985)."),
        field("condition", &ManipulabilityMeasures::condition,
              "Largest over smallest singular value; infinite at a singularity."));
  }
};

template <>
struct Fields<ManipulabilityEllipsoids> {
  static constexpr const char* name = "ManipulabilityEllipsoids";
  static constexpr const char* doc =
      "The velocities J dq of all joint velocities with abs(dq) = 1, and the forces F of all "
      "joint\n"
      "torques with abs(J^T F) = 1 (Lynch & Park, section 5.4). Both have the same axes.";
  static constexpr auto all() {
    return std::tuple(field("axes", &ManipulabilityEllipsoids::axes,
                            "Principal axes: orthonormal columns, as many as the rows of J."),
                      field("velocity", &ManipulabilityEllipsoids::velocity,
                            "Semi-axes, in decreasing order; 0 along which nothing moves."),
                      field("force", &ManipulabilityEllipsoids::force,
                            "Their reciprocals; infinite where the velocity is 0."));
  }
};

template <>
struct Fields<ManipulabilityGradient> {
  static constexpr const char* name = "ManipulabilityGradient";
  static constexpr const char* doc = "Yoshikawa's measure and its derivatives.";
  static constexpr auto all() {
    return std::tuple(
        field("manipulability", &ManipulabilityGradient::manipulability,
              "As in ManipulabilityMeasures."),
        field("gradient", &ManipulabilityGradient::gradient,
              "With respect to the coordinates, per radian or metre, (n,). Zero where the measure "
              "is 0, as it has no derivatives there in general."));
  }
};

}  // namespace beeline::python

#pragma once

#include <beeline/batch/batch.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/kinematics/task.h>

#include "reason.h"
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
inline std::vector<RatesStatus> choices() {
  using enum RatesStatus;
  return {solved, damped, singular, too_few_joints};
}

template <>
struct Fields<JointRatesOptions> {
  static constexpr const char* name = "JointRatesOptions";
  static constexpr auto all() {
    return std::tuple(
        field("task", &JointRatesOptions::task,
              "The rows of the velocity: spatial, position, planar, or a mask such as 111110, of a "
              "planar arm also of x, y, theta such as 110; default: default_task()."),
        field("frame", &JointRatesOptions::frame,
              "Of the velocity, as of jacobian(); default: the task's."),
        field("damping", &JointRatesOptions::damping,
              "lambda of damped least squares, 0 or more: minimise abs(J dq - v)^2 + lambda^2 "
              "abs(dq)^2. With 0 the least abs(dq) among the minimisers of abs(J dq - v)."));
  }
};

template <>
struct Fields<RateExcess> {
  static constexpr const char* name = "RateExcess";
  static constexpr const char* doc = "A joint rate above the velocity limit of its joint.";
  static constexpr auto all() {
    return std::tuple(field("coordinate", &RateExcess::coordinate, "From 0."),
                      field("rate", &RateExcess::rate, "rad/s or m/s."),
                      field("limit", &RateExcess::limit, "rad/s or m/s."));
  }
};

template <>
struct Fields<JointRates> {
  static constexpr const char* name = "JointRates";
  static constexpr const char* doc = "Joint rates dq of a velocity v of the tool.";
  static constexpr const char* truth = "Whether the rates are what was asked for.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &JointRates::status,
              "`solved`: the rates give the velocity. `damped`: those of damped least squares. "
              "`singular`: the velocity has a part in a direction that is lost at a singularity; "
              "`too_few_joints`: in one that the arm has no joint for."),
        field("rates", &JointRates::rates, "dq, rad/s or m/s, (n,); if not solved, the nearest."),
        field("tool_velocity", &JointRates::tool_velocity, "J dq, (m,)."),
        field("residual", &JointRates::residual, "abs(J dq - v), m/s and rad/s."),
        field("singular", &JointRates::singular,
              "Whether J has a smaller rank than its size allows."),
        field(
            "lost_directions", &JointRates::lost_directions,
            "Orthonormal basis, one velocity in each column, of the complement of the range of J."),
        field("excesses", &JointRates::excesses, "Rates above their limits, by coordinate."),
        field("without_limit", &JointRates::without_limit,
              "Coordinates whose velocity limit is not known: their rates are not compared."),
        field("scale", &JointRates::scale,
              "The largest factor of v, at most 1, with which all rates keep the known velocity "
              "limits."),
        field("reason", &JointRates::reason, "One sentence unless solved or damped."));
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

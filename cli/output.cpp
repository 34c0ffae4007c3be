#include "output.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>

using namespace beeline;

std::string shown(double value) {
  constexpr double rounding_noise = 5e-13;
  return fmt::format("{:.6g}", std::abs(value) < rounding_noise ? 0.0 : value);
}

std::string shown(const Eigen::VectorXd& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + shown(value);
  return text;
}

std::string shown(const Pose& pose, bool planar, const UnitArgument& unit) {
  if (planar) {
    const Pose2 plane = to_plane(pose);
    return shown(Vector3(plane.x, plane.y, unit.shown(plane.theta)));
  }
  const Vector3 p = pose.translation();
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  return shown(p) + ", " +
         shown(Vector3(unit.shown(rpy.roll), unit.shown(rpy.pitch), unit.shown(rpy.yaw)));
}

void print_matrix(const Eigen::MatrixXd& matrix, const std::vector<std::string>& row_labels) {
  std::size_t label_width = 0;
  for (const std::string& label : row_labels) label_width = std::max(label_width, label.size());
  std::size_t width = 0;
  for (const double value : matrix.reshaped()) width = std::max(width, shown(value).size());
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    fmt::print("  {:<{}}", row_labels[row], label_width);
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      fmt::print("  {:>{}}", shown(matrix(row, column)), width);
    }
    fmt::print("\n");
  }
}

OrderedJson json_number(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

OrderedJson json_vector(const Eigen::VectorXd& values) {
  OrderedJson list = OrderedJson::array();
  for (const double value : values) list.push_back(json_number(value));
  return list;
}

OrderedJson json_matrix(const Eigen::MatrixXd& matrix) {
  OrderedJson rows = OrderedJson::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(json_vector(row.transpose()));
  return rows;
}

OrderedJson json_pose(const Pose& pose, bool planar, const UnitArgument& unit) {
  const Quaternion q = quaternion(pose.linear());
  OrderedJson document{{"matrix", json_matrix(pose.matrix())},
                       {"translation", json_vector(pose.translation())},
                       {"quaternion", {{"qw", q.qw}, {"qx", q.qx}, {"qy", q.qy}, {"qz", q.qz}}}};
  if (planar) {
    const Pose2 plane = to_plane(pose);
    document["planar"] = {{"x", plane.x}, {"y", plane.y}, {"theta", unit.shown(plane.theta)}};
  }
  return document;
}

void print_json(const OrderedJson& document) { fmt::print("{}\n", document.dump(2)); }

void print_pose(const Pose& pose, bool planar, const UnitArgument& unit) {
  if (planar) {
    const Pose2 plane = to_plane(pose);
    fmt::print("  x {} m   y {} m   theta {} {}\n", shown(plane.x), shown(plane.y),
               shown(unit.shown(plane.theta)), unit.name());
    return;
  }
  const Vector3 p = pose.translation();
  const Quaternion q = quaternion(pose.linear());
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  fmt::print("  position    x {}   y {}   z {}  m\n", shown(p.x()), shown(p.y()), shown(p.z()));
  fmt::print("  rpy         roll {}   pitch {}   yaw {}  {}\n", shown(unit.shown(rpy.roll)),
             shown(unit.shown(rpy.pitch)), shown(unit.shown(rpy.yaw)), unit.name());
  fmt::print("  quaternion  qw {}   qx {}   qy {}   qz {}\n", shown(q.qw), shown(q.qx), shown(q.qy),
             shown(q.qz));
}

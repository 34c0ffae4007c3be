#include "format.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>

using namespace beeline;

std::string shown(double value) {
  constexpr double rounding_error = 5e-13;
  return fmt::format("{:.6g}", std::abs(value) < rounding_error ? 0.0 : value);
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

std::string matrix_text(const Eigen::MatrixXd& matrix, const std::vector<std::string>& row_labels) {
  std::size_t label_width = 0;
  for (const std::string& label : row_labels) label_width = std::max(label_width, label.size());
  std::size_t width = 0;
  for (const double value : matrix.reshaped()) width = std::max(width, shown(value).size());
  std::string text;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    text += fmt::format("  {:<{}}", row_labels[static_cast<std::size_t>(row)], label_width);
    for (const double value : matrix.row(row)) text += fmt::format("  {:>{}}", shown(value), width);
    text += "\n";
  }
  return text;
}

std::string side_by_side(const std::vector<std::pair<std::string, std::string>>& columns) {
  std::vector<std::string> lines;
  std::size_t left = 0;  // width of the columns so far
  for (const auto& [heading, text] : columns) {
    std::vector<std::string> rows{"  " + heading};
    std::istringstream stream(text);
    for (std::string row; std::getline(stream, row);) rows.push_back(row);
    lines.resize(std::max(lines.size(), rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      lines[i].resize(std::max(lines[i].size(), left), ' ');
      lines[i] += rows[i];
    }
    for (const std::string& line : lines) left = std::max(left, line.size() + 3);
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string pose_matrix_text(const Pose& pose, bool planar) {
  if (!planar) return matrix_text(pose.matrix(), std::vector<std::string>(4));
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.topLeftCorner<2, 2>() = pose.linear().topLeftCorner<2, 2>();
  matrix.topRightCorner<2, 1>() = pose.translation().head<2>();
  return matrix_text(matrix, std::vector<std::string>(3));
}

std::string pose_text(const Pose& pose, bool planar, const UnitArgument& unit) {
  if (planar) {
    const Pose2 plane = to_plane(pose);
    return fmt::format("  x {} m   y {} m   theta {} {}\n", shown(plane.x), shown(plane.y),
                       shown(unit.shown(plane.theta)), unit.name());
  }
  const Vector3 p = pose.translation();
  const Quaternion q = quaternion(pose.linear());
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  return fmt::format("  position    x {}   y {}   z {}  m\n", shown(p.x()), shown(p.y()),
                     shown(p.z())) +
         fmt::format("  rpy         roll {}   pitch {}   yaw {}  {}\n", shown(unit.shown(rpy.roll)),
                     shown(unit.shown(rpy.pitch)), shown(unit.shown(rpy.yaw)), unit.name()) +
         fmt::format("  quaternion  qw {}   qx {}   qy {}   qz {}\n", shown(q.qw), shown(q.qx),
                     shown(q.qy), shown(q.qz));
}

std::string counted(std::int64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Json json_matrix(const Eigen::MatrixXd& matrix) {
  Json rows = Json::list();
  for (const auto& row : matrix.rowwise()) rows.append(Eigen::VectorXd(row.transpose()));
  return rows;
}

Json json_pose(const Pose& pose, bool planar, const UnitArgument& unit) {
  const Quaternion q = quaternion(pose.linear());
  Json document{{"matrix", json_matrix(pose.matrix())},
                {"translation", Eigen::VectorXd(pose.translation())},
                {"quaternion", Json{{"qw", q.qw}, {"qx", q.qx}, {"qy", q.qy}, {"qz", q.qz}}}};
  if (planar) {
    const Pose2 plane = to_plane(pose);
    document.add("planar",
                 Json{{"x", plane.x}, {"y", plane.y}, {"theta", unit.shown(plane.theta)}});
  }
  return document;
}

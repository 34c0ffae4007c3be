#include "format.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

namespace beeline::command {
namespace {

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

/// The homogeneous matrix with the position in the unit of the output.
Eigen::Matrix4d shown_matrix(const Pose& pose, const UnitArgument& unit) {
  return make_pose(unit.shown_position(pose), pose.linear()).matrix();
}

/// The orientation in --pose-form, after the position: its names and its numbers.
struct OrientationNumbers {
  std::vector<std::string> names;
  std::vector<double> values;
};

OrientationNumbers orientation_numbers(const Pose& pose, const PoseFormat& format) {
  const std::vector<std::string>& names = pose_columns(*format.pose_form);
  const std::vector<double> values = pose_numbers(pose, format);
  return {{names.begin() + 3, names.end()}, {values.begin() + 3, values.end()}};
}

std::string orientation_line(const Pose& pose, PoseForm form, const UnitArgument& unit) {
  PoseFormat format = unit.pose_format();
  format.pose_form = form;
  const OrientationNumbers orientation = orientation_numbers(pose, format);
  std::string text = fmt::format("  {:<10}", name(form));
  for (std::size_t i = 0; i < orientation.names.size(); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "  " : "   ", orientation.names[i],
                        shown(orientation.values[i]));
  }
  if (form == PoseForm::rpy) text += fmt::format("  {}", unit.name());
  if (form == PoseForm::rotvec) text += "  rad";
  if (form == PoseForm::abc) text += "  deg";
  return text + "\n";
}

}  // namespace

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
  if (planar && unit.pose_form.empty() && is_at_height_zero(pose)) {
    const Vector3 p = unit.shown_position(pose);
    return shown(Vector3(p.x(), p.y(), unit.shown(to_plane(pose).theta)));
  }
  return shown(as_vector(pose_numbers(pose, unit.pose_format())));
}

std::string typed(const Pose& pose, bool planar, const UnitArgument& unit) {
  constexpr double rounding = 1e-12;
  const bool upright = (pose.linear().col(2) - Vector3::UnitZ()).norm() < rounding;
  const bool unrotated = !planar && pose.linear().isIdentity(rounding);
  std::string text =
      unrotated ? shown(unit.shown_position(pose)) : shown(pose, planar && upright, unit);
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return text;
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

std::string pose_matrix_text(const Pose& pose, bool planar, const UnitArgument& unit) {
  const Eigen::Matrix4d spatial = shown_matrix(pose, unit);
  if (!planar) return matrix_text(spatial, std::vector<std::string>(4));
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.topLeftCorner<2, 2>() = spatial.topLeftCorner<2, 2>();
  matrix.topRightCorner<2, 1>() = spatial.topRightCorner<2, 1>();
  return matrix_text(matrix, std::vector<std::string>(3));
}

bool is_at_height_zero(const Pose& pose) {
  constexpr double rounding = 5e-13;
  return std::abs(pose.translation().z()) < rounding;
}

std::string pose_text(const Pose& pose, bool planar, const UnitArgument& unit) {
  const Vector3 p = unit.shown_position(pose);
  const char* length = unit.position_name();
  const auto form = unit.pose_format().pose_form;
  if (planar && !form) {
    const std::string z =
        is_at_height_zero(pose) ? "" : fmt::format("   z {} {}", shown(p.z()), length);
    return fmt::format("  x {} {}   y {} {}{}   theta {} {}\n", shown(p.x()), length, shown(p.y()),
                       length, z, shown(unit.shown(to_plane(pose).theta)), unit.name());
  }
  if (form == PoseForm::matrix) return pose_matrix_text(pose, false, unit);
  const std::string position = fmt::format("  position    x {}   y {}   z {}  {}\n", shown(p.x()),
                                           shown(p.y()), shown(p.z()), length);
  if (form) return position + orientation_line(pose, *form, unit);
  return position + orientation_line(pose, PoseForm::rpy, unit) +
         orientation_line(pose, PoseForm::quaternion, unit);
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
  const Vector3 p = unit.shown_position(pose);
  Json document{{"matrix", json_matrix(shown_matrix(pose, unit))},
                {"translation", Eigen::VectorXd(p)},
                {"quaternion", Json{{"qw", q.qw}, {"qx", q.qx}, {"qy", q.qy}, {"qz", q.qz}}}};
  const PoseFormat format = unit.pose_format();
  const auto form = format.pose_form;
  if (form && form != PoseForm::quaternion && form != PoseForm::matrix) {
    const OrientationNumbers orientation = orientation_numbers(pose, format);
    Json members;
    for (std::size_t i = 0; i < orientation.names.size(); ++i) {
      members.add(orientation.names[i], orientation.values[i]);
    }
    document.add(name(*form), members);
  }
  if (planar) {
    document.add("planar",
                 Json{{"x", p.x()}, {"y", p.y()}, {"theta", unit.shown(to_plane(pose).theta)}});
  }
  return document;
}

}  // namespace beeline::command

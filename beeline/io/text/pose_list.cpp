#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/pose_form.h>
#include <beeline/io/text/internal/stated_units.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<PoseForm> form_names("pose_form");

using internal::in_quotes;
using Names = std::vector<std::string>;

constexpr std::ptrdiff_t max_rows = 4'000'000;  // an hour at 1 kHz

/// The forms of rows without a header.
std::vector<Names> forms_without_names(const PoseFormat& format) {
  std::vector<Names> forms;
  for (const PoseColumns& columns : all_pose_columns()) {
    if (reads_without_names(columns, format)) forms.push_back(columns.names);
  }
  return forms;
}

/// Whether rotation vectors are in degrees.
bool is_vector_in_degrees(const Names& columns, const std::vector<double>& factors) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (columns[i] == "rx" && factors[i] != 1) return true;
  }
  return false;
}

}  // namespace

std::string name(PoseForm value) { return form_names.of(value); }

std::vector<std::string> pose_form_names() { return form_names.all(); }

PoseForm pose_form_named(std::string_view name) { return form_names.named(name); }

const Names& pose_columns(PoseForm form) {
  static const std::array<Names, 5> columns{
      {{"x", "y", "z", "roll", "pitch", "yaw"},
       {"x", "y", "z", "rx", "ry", "rz"},
       {"x", "y", "z", "A", "B", "C"},
       {"x", "y", "z", "qw", "qx", "qy", "qz"},
       {"m11", "m12", "m13", "m14", "m21", "m22", "m23", "m24", "m31", "m32", "m33", "m34", "m41",
        "m42", "m43", "m44"}}};
  return columns[static_cast<std::size_t>(form)];
}

double to_radians(double angle, AngleUnit unit) {
  return unit == AngleUnit::degrees ? angle * std::numbers::pi / 180 : angle;
}

Pose pose_of(std::span<const double> numbers, const PoseFormat& format) {
  const PoseColumns& columns = internal::pose_columns_of(numbers.size(), format, "a pose of ");
  return written_pose(numbers, columns, format).pose;
}

std::vector<double> pose_numbers(const Pose& pose, const PoseFormat& format) {
  const PoseForm form = format.pose_form.value_or(PoseForm::rpy);
  const Vector3 p = pose.translation() * (format.millimetres ? 1000 : 1);
  if (form == PoseForm::matrix) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = make_pose(p, pose.linear()).matrix();
    return {rows.data(), rows.data() + rows.size()};
  }
  std::vector<double> numbers{p.x(), p.y(), p.z()};
  if (form == PoseForm::quaternion) {
    const Quaternion q = quaternion(pose.linear());
    numbers.insert(numbers.end(), {q.qw, q.qx, q.qy, q.qz});
  } else if (form == PoseForm::rotvec) {
    const Vector3 r = so3_log(pose.linear());
    numbers.insert(numbers.end(), {r.x(), r.y(), r.z()});
  } else {
    const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
    const bool degrees = form == PoseForm::abc || format.angle_unit == AngleUnit::degrees;
    const double unit = degrees ? 180 / std::numbers::pi : 1;
    if (form == PoseForm::abc) {
      numbers.insert(numbers.end(), {rpy.yaw * unit, rpy.pitch * unit, rpy.roll * unit});
    } else {
      numbers.insert(numbers.end(), {rpy.roll * unit, rpy.pitch * unit, rpy.yaw * unit});
    }
  }
  return numbers;
}

PoseList poses_from_csv(std::string_view text, const std::string& path, const PoseFormat& format) {
  if (std::max(std::count(text.begin(), text.end(), '\n'),
               std::count(text.begin(), text.end(), '\r')) > max_rows) {
    throw FileError(path, 0, "has more than " + std::to_string(max_rows) + " lines");
  }
  internal::CsvLines lines(text, path);
  internal::CsvRows rows(lines, path, {forms_without_names(format), internal::names_pose});
  PoseList list{.has_header = rows.has_header()};
  try {
    const internal::ColumnsInUnits named = internal::known_columns(rows.columns());
    const Names& header = named.names;
    if (!rows.has_header()) internal::check_triple(header.size(), format, "a row has ");
    const PoseColumns& columns = internal::pose_columns_of(header);
    list.columns = columns.names;
    list.planar = columns.planar;
    list.oriented = columns.oriented;
    list.form = columns.form;
    std::vector<std::size_t> column_of;  // of each number of the form
    for (const std::string& name : columns.names) {
      const auto column = std::find(header.begin(), header.end(), name);
      column_of.push_back(static_cast<std::size_t>(column - header.begin()));
    }
    const std::vector<double> factors = internal::pose_factors(named, format, rows.stated(), path);
    list.vector_in_degrees = is_vector_in_degrees(header, factors);
    list.commented_units = internal::commented_units(named, rows.stated(), factors);
    std::vector<double> values(columns.names.size());
    for (std::vector<double> row; rows.next(row);) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = factors[column_of[i]] * row[column_of[i]];
      }
      const WrittenPose written = written_pose(values, columns, format);
      list.poses.push_back(checked_pose(written.pose));
      list.lines.push_back(rows.line());
      if (std::abs(written.max_angle) > std::abs(list.max_angle))
        list.max_angle = written.max_angle;
    }
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, rows.line(), error.what());
  }
  return list;
}

PoseList read_poses(const std::string& path, const PoseFormat& format) {
  return poses_from_csv(read_file(path), path, format);
}

WrittenPose parse_pose(std::string_view text, const PoseFormat& format) {
  const bool of_urscript = text.starts_with("p[");
  const PoseFormat read = of_urscript ? PoseFormat{.pose_form = PoseForm::rotvec} : format;
  const std::vector<double> values = parse_numbers(text.substr(of_urscript ? 1 : 0), "pose");
  const PoseColumns& columns =
      internal::pose_columns_of(values.size(), read, "pose " + in_quotes(text) + " has ");
  return written_pose(values, columns, read);
}

}  // namespace beeline

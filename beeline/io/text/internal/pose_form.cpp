#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/pose_form.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the names of `wanted` that `present` lacks.
Names missing_from(const Names& present, const Names& wanted) {
  Names missing;
  for (const std::string& name : wanted) {
    if (!contains(present, name)) missing.push_back(name);
  }
  return missing;
}

/// The rotation of a rotation vector. Of a very long one so3_exp() would overflow.
Rotation rotation_by(const Vector3& rotation_vector) {
  constexpr double max_length = 1e150;
  const double angle = rotation_vector.stableNorm();
  if (angle <= max_length) return so3_exp(rotation_vector);
  if (!std::isfinite(angle)) {
    throw Error("the length of the rotation vector exceeds the range of numbers, 1e308");
  }
  return so3_exp(std::remainder(angle, 2 * std::numbers::pi) * (rotation_vector / angle));
}

/// The rotation of a pose in a form other than the matrix: `v` has the numbers of its orientation.
Rotation rotation_in(PoseForm form, std::span<const double> v, AngleUnit unit) {
  if (form == PoseForm::quaternion) return rotation_from_quaternion(v[0], v[1], v[2], v[3]);
  if (form == PoseForm::rotvec) return rotation_by(Vector3(v[0], v[1], v[2]));
  if (form == PoseForm::abc) {
    const auto radians = [&](int i) { return to_radians(v[i], AngleUnit::degrees); };
    return rotation(RollPitchYaw{.roll = radians(2), .pitch = radians(1), .yaw = radians(0)});
  }
  return rotation(
      RollPitchYaw{to_radians(v[0], unit), to_radians(v[1], unit), to_radians(v[2], unit)});
}

/// Whether the numbers are a rigid motion column by column, as libfranka and MATLAB write it.
bool is_column_by_column(std::span<const double> v) {
  Pose pose = Pose::Identity();
  const std::size_t height = v.size() / 4;
  for (std::size_t i = 0; i < v.size(); ++i) {
    pose.matrix()(static_cast<Eigen::Index>(i % height), static_cast<Eigen::Index>(i / height)) =
        v[i];
  }
  constexpr double rounding = 1e-6;
  if (!pose.matrix().row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), rounding)) return false;
  try {
    checked_pose(pose);
    return true;
  } catch (const Error&) {
    return false;
  }
}

Pose pose_row_by_row(std::span<const double> v) {
  Pose pose = Pose::Identity();
  for (std::size_t i = 0; i < 12; ++i) {
    pose.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = v[i];
  }
  constexpr double rounding = 1e-6;
  for (std::size_t i = 12; i < v.size(); ++i) {
    if (std::abs(v[i] - (i == 15 ? 1 : 0)) <= rounding) continue;
    throw Error("the matrix ends in the row " + number(v[12]) + ", " + number(v[13]) + ", " +
                number(v[14]) + ", " + number(v[15]) + "; it must be 0, 0, 0, 1");
  }
  return checked_pose(pose, "the matrix");
}

Pose pose_from_matrix(std::span<const double> v) {
  try {
    return pose_row_by_row(v);
  } catch (const Error& error) {
    if (!is_column_by_column(v)) throw;
    throw Error(std::string(error.what()) +
                "; these numbers are a pose column by column: write it row by row");
  }
}

/// The number that is largest by magnitude.
double largest(std::span<const double> numbers) {
  double most = 0;
  for (const double value : numbers) {
    if (std::abs(value) > std::abs(most)) most = value;
  }
  return most;
}

}  // namespace

const std::string& known_pose_columns() {
  static const std::string text =
      "x,y,theta or x,y,z,roll,pitch,yaw or x,y,z,qw,qx,qy,qz or x,y,z,rx,ry,rz or x,y,z,A,B,C or "
      "m11,m12,...,m44, and positions x,y,z or x,y";
  return text;
}

void check_triple(std::size_t count, const PoseFormat& format, const std::string& what) {
  if (count != 3 || format.triple) return;
  throw Error(what + "3 numbers, x,y,theta or x,y,z; give ", "triple",
              "=\"planar\" or triple=\"position\"");
}

const PoseColumns& pose_columns_of(std::size_t count, const PoseFormat& format,
                                   const std::string& what) {
  check_triple(count, format, what);
  for (const PoseColumns& columns : all_pose_columns()) {
    if (columns.names.size() == count && reads_without_names(columns, format)) return columns;
  }
  const std::string given = what + std::to_string(count) + " numbers; ";
  if (!format.pose_form) throw Error(given + "poses are " + known_pose_columns());
  const Names& names = pose_columns(*format.pose_form);
  std::string wanted;
  for (const std::string& column : names) wanted += (wanted.empty() ? "" : ",") + column;
  if (format.pose_form == PoseForm::matrix) wanted = "m11,m12,...,m44 or m11,m12,...,m34";
  throw Error(given, "pose_form", " " + name(*format.pose_form) + " has " + wanted);
}

const PoseColumns& pose_columns_of(const Names& header) {
  const std::string known =
      "; poses are " + known_pose_columns() + "; programs also have " + listed(program_columns());
  const std::vector<PoseColumns>& all = all_pose_columns();
  for (const std::string& name : header) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const PoseColumns& columns) {
      return contains(columns.names, name);
    });
    if (!is_known) throw Error("unknown column " + in_quotes(name) + known);
  }
  // The nearest form with an orientation: the fewest columns that it does not have, then the fewest
  // that are missing.
  const PoseColumns* nearest = &all.front();
  const auto distance = [&](const PoseColumns& columns) {
    return std::pair(missing_from(columns.names, header).size(),
                     missing_from(header, columns.names).size());
  };
  for (const PoseColumns& columns : all) {
    const auto apart = distance(columns);
    if (apart == std::pair<std::size_t, std::size_t>(0, 0)) return columns;
    if (columns.oriented && apart < distance(*nearest)) nearest = &columns;
  }
  const Names missing = missing_from(header, nearest->names);
  const Names extra = missing_from(nearest->names, header);
  const auto columns = [](const Names& names, const char* one, const char* several) {
    return (names.size() == 1 ? "column " : "columns ") + listed(names) +
           (names.size() == 1 ? one : several);
  };
  if (!missing.empty()) {
    throw Error(columns(missing, " is missing", " are missing") + " beside " + listed(header) +
                known);
  }
  throw Error(columns(extra, " does not", " do not") + " belong to " + listed(nearest->names) +
              known);
}

ColumnsInUnits known_columns(const Names& header) {
  static const std::unordered_map<std::string, std::string> known = [] {
    std::unordered_map<std::string, std::string> names;
    for (const PoseColumns& columns : all_pose_columns()) {
      for (const std::string& name : columns.names) names.emplace(lower_case(name), name);
    }
    for (const std::string& name : program_columns()) names.emplace(name, name);
    return names;
  }();
  ColumnsInUnits columns = columns_in_units(header, {});
  std::unordered_set<std::string> seen;
  for (std::size_t i = 0; i < header.size(); ++i) {
    std::string& name = columns.names[i];
    const auto found = known.find(lower_case(name));
    name = found != known.end() ? found->second : header[i];
    const NameInUnit in_time = split_at_time_unit(header[i]);
    if (in_time.unit != nullptr && lower_case(in_time.stem) == "dwell") {
      name = "dwell";
      columns.units[i] = in_time.unit;
    }
    const bool has_no_unit = contains({"motion", "relative", "q"}, name);
    if (columns.units[i] != nullptr && has_no_unit) name = header[i];
    if (!seen.insert(name).second) {
      throw Error("column " + in_quotes(name) + " is given twice, in upper and lower case");
    }
  }
  return columns;
}

std::vector<double> pose_factors(ColumnsInUnits columns, const PoseFormat& format,
                                 const StatedUnits& stated, const std::string& path) {
  Names wanted;
  for (std::size_t i = 0; i < columns.names.size(); ++i) {
    wanted.push_back(unit_of_column(columns.names[i], format));
    if (contains(program_columns(), columns.names[i])) columns.units[i] = nullptr;
  }
  return factors_to(wanted, columns, stated, path);
}

bool names_pose(const Names& header) {
  try {
    pose_columns_of(known_columns(header).names);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace beeline::internal

namespace beeline {

const std::vector<PoseColumns>& all_pose_columns() {
  static const std::vector<PoseColumns> all = [] {
    std::vector<PoseColumns> columns{{.names = {"x", "y", "theta"}, .planar = true}};
    for (const PoseForm form :
         {PoseForm::rpy, PoseForm::quaternion, PoseForm::rotvec, PoseForm::abc}) {
      columns.push_back({pose_columns(form), form});
    }
    const std::vector<std::string>& matrix = pose_columns(PoseForm::matrix);
    columns.push_back({{matrix.begin(), matrix.begin() + 12}, PoseForm::matrix});
    columns.push_back({matrix, PoseForm::matrix});
    columns.push_back({.names = {"x", "y", "z"}, .oriented = false});
    columns.push_back({.names = {"x", "y"}, .planar = true, .oriented = false});
    return columns;
  }();
  return all;
}

bool reads_without_names(const PoseColumns& columns, const PoseFormat& format) {
  if (columns.names.size() == 3) {
    return !format.triple || columns.planar == (*format.triple == Triple::planar);
  }
  if (!columns.form) return true;
  if (format.pose_form) return *columns.form == *format.pose_form;
  return columns.names.size() != 6 || *columns.form == PoseForm::rpy;
}

WrittenPose written_pose(std::span<const double> numbers, const PoseColumns& columns,
                         const PoseFormat& format) {
  WrittenPose written{.pose = Pose::Identity(),
                      .planar = columns.planar,
                      .oriented = columns.oriented,
                      .form = columns.form};
  const std::span<const double> rest = numbers.subspan(std::min<std::size_t>(numbers.size(), 3));
  if (columns.form == PoseForm::matrix) {
    written.pose = internal::pose_from_matrix(numbers);
  } else if (columns.form) {
    written.pose = make_pose({numbers[0], numbers[1], numbers[2]},
                             internal::rotation_in(*columns.form, rest, format.angle_unit));
    if (columns.form == PoseForm::rpy)
      written.max_angle = to_radians(internal::largest(rest), format.angle_unit);
    if (columns.form == PoseForm::rotvec)
      written.max_angle = Vector3(rest[0], rest[1], rest[2]).stableNorm();
  } else if (columns.planar) {
    written.max_angle = columns.oriented ? to_radians(numbers[2], format.angle_unit) : 0;
    written.pose = to_space(Pose2{numbers[0], numbers[1], written.max_angle});
  } else {
    written.pose = make_pose({numbers[0], numbers[1], numbers[2]});
  }
  if (format.millimetres) written.pose.translation() /= 1000;
  return written;
}

std::string unit_of_column(const std::string& name, const PoseFormat& format) {
  static const std::vector<std::string> positions{"x", "y", "z", "m14", "m24", "m34"};
  static const std::vector<std::string> angles{"theta", "roll", "pitch", "yaw"};
  static const std::vector<std::string> rotation_vectors{"rx", "ry", "rz"};
  static const std::vector<std::string> kuka{"A", "B", "C"};
  const auto has = [&name](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool degrees = format.angle_unit == AngleUnit::degrees;
  if (has(positions)) return format.millimetres ? "mm" : "m";
  if (has(angles)) return degrees ? "deg" : "rad";
  if (has(rotation_vectors)) return "rad";
  return has(kuka) ? "deg" : "";
}

}  // namespace beeline

#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/pose/orientation.h>
#include <beeline/pose/se2.h>
#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/read/internal/pose_form.h>
#include <beeline/read/pose_list.h>

namespace beeline {
namespace {

using internal::in_quotes;
using internal::known_forms;
using Names = std::vector<std::string>;

/// The larger one, by magnitude, of `other` and the largest angle of a pose.
double larger_angle(std::span<const double> pose, AngleUnit unit, Triple triple, double other) {
  const bool theta = pose.size() == 3 && triple == Triple::planar;
  const std::size_t first = theta ? 2 : pose.size() == 6 ? 3 : pose.size();
  for (const double angle : pose.subspan(first)) {
    const double radians = to_radians(angle, unit);
    if (std::abs(radians) > std::abs(other)) other = radians;
  }
  return other;
}

/// Throws FileError for a header that is not that of a form, whatever its rows are.
void check_header(std::string_view text, const std::string& path, const std::vector<Names>& forms) {
  internal::CsvLines lines(text, path);
  const internal::CsvRows header(lines, path, forms);
  try {
    internal::pose_form_of(header.columns());
  } catch (const Error& error) {
    throw FileError(path, header.line(), error.what());
  }
}

}  // namespace

double to_radians(double angle, AngleUnit unit) {
  return unit == AngleUnit::degrees ? angle * std::numbers::pi / 180 : angle;
}

const std::array<Names, 5>& pose_forms() {
  static const std::array<Names, 5> known{{{"x", "y", "theta"},
                                           {"x", "y", "z", "roll", "pitch", "yaw"},
                                           {"x", "y", "z", "qw", "qx", "qy", "qz"},
                                           {"x", "y", "z"},
                                           {"x", "y"}}};
  return known;
}

Pose pose_of(std::span<const double> v, AngleUnit unit, Triple triple) {
  const auto radians = [unit](double angle) { return to_radians(angle, unit); };
  if (v.size() == 2) return make_pose({v[0], v[1], 0});
  if (v.size() == 3 && triple == Triple::position) return make_pose({v[0], v[1], v[2]});
  if (v.size() == 3) return to_space(Pose2{v[0], v[1], radians(v[2])});
  if (v.size() != 6 && v.size() != 7) {
    throw Error("a pose of " + std::to_string(v.size()) + " numbers; poses are " + known_forms);
  }
  const Vector3 position(v[0], v[1], v[2]);
  if (v.size() == 6) {
    return make_pose(position, rotation(RollPitchYaw{radians(v[3]), radians(v[4]), radians(v[5])}));
  }
  return make_pose(position, rotation_from_quaternion(v[3], v[4], v[5], v[6]));
}

WrittenPose internal::written_pose(std::span<const double> numbers, AngleUnit unit, Triple triple) {
  const bool position = numbers.size() == 3 && triple == Triple::position;
  return {.pose = pose_of(numbers, unit, triple),
          .planar = numbers.size() <= 3 && !position,
          .max_angle = larger_angle(numbers, unit, triple, 0),
          .oriented = numbers.size() > 2 && !position};
}

PoseList poses_from_csv(std::string_view text, const std::string& path, AngleUnit unit,
                        Triple triple) {
  const Names& three = pose_forms()[triple == Triple::planar ? 0 : 3];
  const std::vector<Names> forms{three, pose_forms()[1], pose_forms()[2], pose_forms()[4]};
  check_header(text, path, forms);
  const internal::CsvTable table = internal::parse_csv(text, path, forms);
  PoseList list{.lines = table.lines, .has_header = table.has_header};
  int line = 0;  // unknown for the header: comments may precede it
  try {
    const Names& form = internal::pose_form_of(table.columns);
    list.columns = form;
    triple = form == pose_forms()[3] ? Triple::position : Triple::planar;
    list.planar = form.size() == 2 || (form.size() == 3 && triple == Triple::planar);
    list.oriented = form.size() > 3 || form == pose_forms()[0];
    std::vector<std::size_t> column_of;  // of each number of the form
    for (const std::string& name : form) {
      const auto column = std::find(table.columns.begin(), table.columns.end(), name);
      column_of.push_back(static_cast<std::size_t>(column - table.columns.begin()));
    }
    std::vector<double> values(form.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      line = table.lines[row];
      for (std::size_t i = 0; i < form.size(); ++i) values[i] = table.rows[row][column_of[i]];
      list.poses.push_back(checked_pose(pose_of(values, unit, triple)));
      list.max_angle = larger_angle(values, unit, triple, list.max_angle);
    }
  } catch (const Error& error) {
    throw FileError(path, line, error.what());
  }
  return list;
}

PoseList read_poses(const std::string& path, AngleUnit unit, Triple triple) {
  return poses_from_csv(internal::read_file(path), path, unit, triple);
}

WrittenPose parse_pose(std::string_view text, AngleUnit unit, Triple triple) {
  const std::vector<double> values = internal::parse_numbers(text, "pose");
  const bool known = std::any_of(pose_forms().begin(), pose_forms().end(),
                                 [&](const Names& form) { return form.size() == values.size(); });
  if (!known) {
    throw Error("pose " + in_quotes(text) + " has " + std::to_string(values.size()) +
                " numbers; poses are " + known_forms);
  }
  return internal::written_pose(values, unit, triple);
}

}  // namespace beeline

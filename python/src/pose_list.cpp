#include <cmath>

#include "bindings.h"
#include "pose_list_fields.h"
#include "warning_category.h"

namespace beeline::python {
namespace {

PoseFormat format_from(nb::handle unit, nb::handle triple, nb::handle pose_form,
                       nb::handle millimetres) {
  return {.angle_unit = Value<AngleUnit>::from(unit, "angle_unit"),
          .triple = Value<std::optional<Triple>>::from(triple, "triple"),
          .pose_form = Value<std::optional<PoseForm>>::from(pose_form, "pose_form"),
          .millimetres = Value<bool>::from(millimetres, "millimetres")};
}

/// Issues the warning of an angle that is more than a revolution; `where` names the numbers.
void warn_of_angle(const std::string& where, double angle, std::optional<PoseForm> form,
                   const PoseFormat& format) {
  if (const auto note = angle_note(angle, form, format)) warn_of_input(sentence(*note, where));
}

PoseList poses_in(const std::string& path, const PoseFormat& format) {
  PoseList list = read_poses(path, format);
  for (const PoseNote& note : notes_on(list, format)) warn_of_input(sentence(note, path));
  return list;
}

Pose warned_pose(const WrittenPose& written, const char* name, const PoseFormat& format) {
  warn_of_angle(name, written.max_angle, written.form, format);
  return written.pose;
}

/// The pose of numbers without names.
Pose pose_from(nb::handle given, const PoseFormat& format) {
  const auto values = finite_from<Eigen::VectorXd>(given, "numbers");
  const std::span<const double> numbers(values.data(), static_cast<std::size_t>(values.size()));
  const Pose pose = checked_pose(pose_of(numbers, format));
  for (const PoseColumns& columns : all_pose_columns()) {
    if (columns.names.size() != numbers.size() || !reads_without_names(columns, format)) continue;
    warned_pose(written_pose(numbers, columns, format), "numbers", format);
    break;
  }
  return pose;
}

/// Adds a function of one argument and of a PoseFormat, whose members may be given by position.
template <class Evaluate>
void of_format(nb::module_& m, Signature signature, const char* argument, Evaluate evaluate) {
  define(
      m,
      [evaluate](nb::handle value, nb::handle unit, nb::handle triple, nb::handle pose_form,
                 nb::handle millimetres, nb::handle former_unit) {
        refuse_former(former_unit, "unit", "angle_unit");
        return evaluate(value, format_from(unit, triple, pose_form, millimetres));
      },
      signature.member<&PoseFormat::angle_unit>()
          .member<&PoseFormat::triple>()
          .keywords()
          .member<&PoseFormat::pose_form>()
          .member<&PoseFormat::millimetres>(),
      nb::arg(argument), nb::arg("angle_unit") = "radians", nb::arg("triple") = nb::none(),
      nb::kw_only(), nb::arg("pose_form") = nb::none(), nb::arg("millimetres") = false,
      nb::arg("unit") = nb::none());
}

}  // namespace

void bind_pose_lists(nb::module_& m) {
  bind_record<PoseList>(m);
  of_format(
      m,
      Signature("read_poses", "PoseList",
                "Reads a CSV file whose header names the columns of one form, in any order: "
                "x,y,theta; x,y,z,roll,pitch,yaw; x,y,z,qw,qx,qy,qz; x,y,z,rx,ry,rz; x,y,z,A,B,C; "
                "m11,m12,...,m44; x,y,z; x,y. Raises FileError for invalid lines, which it names.")
          .takes("path", path_like, "Path.")
          .returns("The poses, with what the file says of them."),
      "path", [](nb::handle path, const PoseFormat& format) {
        return poses_in(path_from(path, "path"), format);
      });
  of_format(m,
            Signature("parse_pose", array_type,
                      "Returns the pose (4, 4) that 2, 3, 6, 7, 12 or 16 numbers separated by "
                      "commas give, in the forms of read_poses().")
                .takes("text", "str", "Such as `0.4,0,0.3,3.1416,0,0`.")
                .returns("(4, 4)."),
            "text", [](nb::handle text, const PoseFormat& format) {
              const std::string numbers = Value<std::string>::from(text, "text");
              return Value<Pose>::to(warned_pose(parse_pose(numbers, format), "text", format));
            });
  of_format(m,
            Signature("pose_of", array_type,
                      "Returns the pose (4, 4) that 2, 3, 6, 7, 12 or 16 numbers give, in the "
                      "forms of read_poses().")
                .takes("numbers", array_like, "Such as `[525, 0, 700, 0, 90, 0]`, (k,).")
                .returns("(4, 4)."),
            "numbers", [](nb::handle numbers, const PoseFormat& format) {
              return Value<Pose>::to(pose_from(numbers, format));
            });
  of_format(m,
            Signature("pose_numbers", array_type,
                      "Returns the numbers of a pose in the form `pose_form`, by default `rpy`: "
                      "pose_of() with the same keywords reads them back, to rounding.")
                .takes("pose", array_like, pose_doc)
                .returns("The numbers, (k,)."),
            "pose", [](nb::handle pose, const PoseFormat& format) {
              const std::vector<double> numbers =
                  pose_numbers(Value<Pose>::from(pose, "pose"), format);
              return Value<Eigen::VectorXd>::to(
                  Eigen::Map<const Eigen::VectorXd>(numbers.data(), Index(numbers.size())));
            });
}

}  // namespace beeline::python

#include "bindings.h"
#include "pose_list_fields.h"

namespace beeline::python {
namespace {

PoseFormat format_from(nb::handle unit, nb::handle triple, nb::handle pose_form,
                       nb::handle millimetres) {
  return {.unit = Value<AngleUnit>::from(unit, "unit"),
          .triple = Value<Triple>::from(triple, "triple"),
          .pose_form = Value<std::optional<PoseForm>>::from(pose_form, "pose_form"),
          .millimetres = Value<bool>::from(millimetres, "millimetres")};
}

/// Adds a function of one argument and of a PoseFormat, whose members may be given by position.
template <class Evaluate>
void of_format(nb::module_& m, Signature signature, const char* argument, Evaluate evaluate) {
  define(
      m,
      [evaluate](nb::handle value, nb::handle unit, nb::handle triple, nb::handle pose_form,
                 nb::handle millimetres) {
        return evaluate(value, format_from(unit, triple, pose_form, millimetres));
      },
      signature.member<&PoseFormat::unit>()
          .member<&PoseFormat::triple>()
          .keywords()
          .member<&PoseFormat::pose_form>()
          .member<&PoseFormat::millimetres>(),
      nb::arg(argument), nb::arg("unit") = "radians", nb::arg("triple") = "planar", nb::kw_only(),
      nb::arg("pose_form") = nb::none(), nb::arg("millimetres") = false);
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
          .takes("path", path_like, "Path."),
      "path", [](nb::handle path, const PoseFormat& format) {
        return read_poses(path_from(path, "path"), format);
      });
  of_format(m,
            Signature("parse_pose", array_type,
                      "Returns the pose (4, 4) that 2, 3, 6, 7, 12 or 16 numbers separated by "
                      "commas give, in the forms of read_poses().")
                .takes("text", "str", "Such as `0.4,0,0.3,3.1416,0,0`."),
            "text", [](nb::handle text, const PoseFormat& format) {
              const std::string numbers = Value<std::string>::from(text, "text");
              return Value<Pose>::to(parse_pose(numbers, format).pose);
            });
  of_format(m,
            Signature("pose_of", array_type,
                      "Returns the pose (4, 4) that 2, 3, 6, 7, 12 or 16 numbers give, in the "
                      "forms of read_poses().")
                .takes("numbers", array_like, "Such as `[525, 0, 700, 0, 90, 0]`, (k,)."),
            "numbers", [](nb::handle numbers, const PoseFormat& format) {
              const auto values = finite_from<Eigen::VectorXd>(numbers, "numbers");
              const std::span<const double> all(values.data(),
                                                static_cast<std::size_t>(values.size()));
              return Value<Pose>::to(checked_pose(pose_of(all, format)));
            });
  of_format(m,
            Signature("pose_numbers", array_type,
                      "Returns the numbers of a pose in the form `pose_form`, by default `rpy`: "
                      "pose_of() with the same keywords reads them back, to rounding.")
                .takes("pose", array_like, pose_doc),
            "pose", [](nb::handle pose, const PoseFormat& format) {
              const std::vector<double> numbers =
                  pose_numbers(Value<Pose>::from(pose, "pose"), format);
              return Value<Eigen::VectorXd>::to(
                  Eigen::Map<const Eigen::VectorXd>(numbers.data(), Index(numbers.size())));
            });
}

}  // namespace beeline::python

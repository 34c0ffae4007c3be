#include "bindings.h"
#include "pose_list_fields.h"

namespace beeline::python {

void bind_pose_lists(nb::module_& m) {
  bind_record<PoseList>(m);
  const auto add = [&m](auto function, Signature signature, const char* first) {
    signature.takes("unit", Value<AngleUnit>::type(), "Of angles in the text.", "'radians'")
        .takes("triple", Value<Triple>::type(),
               "The meaning of three numbers without names: x,y,theta or x,y,z.", "'planar'");
    define(m, function, signature, nb::arg(first), nb::arg("unit") = "radians",
           nb::arg("triple") = "planar");
  };
  add(
      [](nb::handle path, nb::handle unit, nb::handle triple) {
        return read_poses(path_from(path, "path"), Value<AngleUnit>::from(unit, "unit"),
                          Value<Triple>::from(triple, "triple"));
      },
      Signature("read_poses", "PoseList",
                "Reads a CSV file whose header names the columns of one form, in any order: "
                "x,y,theta; x,y,z,roll,pitch,yaw; x,y,z,qw,qx,qy,qz; x,y,z; x,y. Metres, and rpy "
                "about fixed axes as in URDF. Raises FileError for invalid lines, which it names.")
          .takes("path", path_like, "Path."),
      "path");
  add(
      [](nb::handle text, nb::handle unit, nb::handle triple) {
        return Value<Pose>::to(parse_pose(Value<std::string>::from(text, "text"),
                                          Value<AngleUnit>::from(unit, "unit"),
                                          Value<Triple>::from(triple, "triple"))
                                   .pose);
      },
      Signature("parse_pose", array_type,
                "Returns the pose (4, 4) that 2, 3, 6 or 7 numbers separated by commas give, in "
                "the forms of read_poses().")
          .takes("text", "str", "Such as `0.4,0,0.3,3.1416,0,0`."),
      "text");
}

}  // namespace beeline::python

#include "bindings.h"
#include "pose_fields.h"

namespace beeline::python {

void bind_planar_poses(nb::module_& m) {
  nb::class_<Pose2> pose = bind_record<Pose2>(m);
  pose.def(
      "__matmul__", [](const Pose2& a, const Pose2& b) { return a * b; }, nb::is_operator(),
      nb::sig("def __matmul__(self, other: Pose2, /) -> Pose2"));
  pose.def(
      "inverse", [](const Pose2& self) { return inverse(self); }, "Returns the inverse.");
  Signature exp("se2_exp", "Pose2", "Returns the exponential of a planar twist for unit time.");
  exp.takes("twist", array_like, "[vx vy w], m and rad, (3,).");
  define(
      m, [](nb::handle twist) { return se2_exp(finite_from<Twist2>(twist, "twist")); }, exp,
      nb::arg("twist"));
  Signature log("se2_log", array_type, "Returns the logarithm (3,), theta in [-pi, pi].");
  log.takes("pose", "Pose2");
  define(
      m, [](const Pose2& planar) { return Value<Twist2>::to(se2_log(planar)); }, log,
      nb::arg("pose"));
  Signature space("to_space", array_type,
                  "Returns a planar pose as a spatial one (4, 4) in the plane z = height.");
  space.takes("pose", "Pose2").takes("height", "float", "Metres.", "0.0");
  define(
      m,
      [](const Pose2& planar, nb::handle height) {
        return Value<Pose>::to(to_space(planar, Value<double>::from(height, "height")));
      },
      space, nb::arg("pose"), nb::arg("height") = 0.0);
  Signature plane(
      "to_plane", "typing.Any",
      "Returns the planar part of a pose, without its height and tilt: a Pose2. Of many "
      "poses a list of them.");
  plane.takes("pose", array_like,
              "Pose (4, 4), or poses (N, 4, 4) as forward_kinematics() returns.");
  define(
      m,
      [](nb::handle spatial) -> nb::object {
        const InputArray array(matrix_of(spatial), "pose");
        if (array.dimensions() != 3) return nb::cast(to_plane(Value<Pose>::from(spatial, "pose")));
        nb::list all;
        for (const Pose& each : poses_from(spatial, "pose")) all.append(nb::cast(to_plane(each)));
        return all;
      },
      plane, nb::arg("pose"));
}

}  // namespace beeline::python

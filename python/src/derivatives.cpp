#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

#include "bindings.h"
#include "kinematics_fields.h"
#include "rows.h"

namespace beeline::python {
namespace {

constexpr const char* velocities_doc =
    "Joint velocities, rad/s or m/s: (n,), or of the shape of q.";
const std::string optional_array = std::string(array_type) + " | None";

Signature row_signature(const char* name, const char* summary) {
  Signature signature(name, array_type, summary);
  signature.takes_arm().takes("q", array_like, configurations_doc);
  return signature;
}

Signature& takes_frame(Signature& signature) {
  return signature.takes("frame", Value<Frame>::type(), "As of jacobian().", "'base'");
}

Signature& takes_out(Signature& signature) {
  return signature.keywords().takes("out", optional_array,
                                    "Array for the result, apart from the arguments.", "None");
}

nb::object derivative(const Arm& arm, nb::handle q, nb::handle dq, nb::handle frame_name,
                      nb::handle out) {
  const Configurations configurations(arm, q);
  const RowArgument velocities(dq, "dq", arm.dof(), configurations);
  const Frame frame = Value<Frame>::from(frame_name, "frame");
  return for_rows(
      configurations, {6, arm.dof()}, out,
      [&](Index i, double* result) {
        jacobian_derivative(arm, configurations.row(i), velocities.row(i),
                            Eigen::Map<Jacobian>(result, 6, arm.dof()), frame);
      },
      velocities);
}

nb::object hessian_of(const Arm& arm, nb::handle q, nb::handle frame_name, nb::handle out) {
  const Configurations configurations(arm, q);
  const Frame frame = Value<Frame>::from(frame_name, "frame");
  const Index n = arm.dof();
  Jacobian columns(6, n);
  return for_rows(configurations, {n, 6, n}, out, [&](Index i, double* result) {
    hessian(arm, configurations.row(i), columns, Eigen::Map<Hessian>(result, 6, n * n), frame);
  });
}

nb::object acceleration(const Arm& arm, nb::handle q, nb::handle dq, nb::handle ddq,
                        nb::handle frame_name, nb::handle out) {
  const Configurations configurations(arm, q);
  const RowArgument velocities(dq, "dq", arm.dof(), configurations);
  const RowArgument accelerations(ddq, "ddq", arm.dof(), configurations);
  const Frame frame = Value<Frame>::from(frame_name, "frame");
  return for_rows(
      configurations, {6}, out,
      [&](Index i, double* result) {
        Eigen::Map<Twist> twist(result);
        twist = tool_acceleration(arm, configurations.row(i), velocities.row(i),
                                  accelerations.row(i), frame);
      },
      velocities, accelerations);
}

nb::object torques(const Arm& arm, nb::handle q, nb::handle wrench, nb::handle frame_name,
                   nb::handle out) {
  const Configurations configurations(arm, q);
  const RowArgument wrenches(wrench, "wrench", 6, configurations);
  const Frame frame = Value<Frame>::from(frame_name, "frame");
  return for_rows(
      configurations, {arm.dof()}, out,
      [&](Index i, double* result) {
        Eigen::Map<Configuration> torques(result, arm.dof());
        torques = joint_torques(arm, configurations.row(i), wrenches.row(i), frame);
      },
      wrenches);
}

nb::object planar(const Arm& arm, nb::handle q, nb::handle out) {
  const Configurations configurations(arm, q);
  return for_rows(configurations, {3, arm.dof()}, out, [&](Index i, double* result) {
    Eigen::Map<Eigen::Matrix3Xd> columns(result, 3, arm.dof());
    columns = planar_jacobian(arm, configurations.row(i));
  });
}

nb::object analytical(const Arm& arm, nb::handle q, nb::handle coordinates_name, nb::handle out) {
  const Configurations configurations(arm, q);
  const auto coordinates = Value<OrientationCoordinates>::from(coordinates_name, "coordinates");
  const Index rows = coordinates == OrientationCoordinates::quaternion ? 7 : 6;
  return for_rows(configurations, {rows, arm.dof()}, out, [&](Index i, double* result) {
    Eigen::Map<Eigen::MatrixXd> columns(result, rows, arm.dof());
    columns = analytical_jacobian(arm, configurations.row(i), coordinates);
  });
}

void bind_jacobians(nb::module_& m) {
  Signature plane =
      row_signature("planar_jacobian",
                    "Returns the Jacobian of a planar arm as in the chapter: rows [x y theta], in "
                    "the world's axes. Raises Error when the arm is not planar.");
  takes_out(plane).returns("(3, n), or (..., 3, n).");
  define(m, &planar, plane, nb::arg("arm"), nb::arg("q"), nb::kw_only(),
         nb::arg("out") = nb::none());

  Signature coordinates = row_signature(
      "analytical_jacobian",
      "Returns the analytical Jacobian: derivatives of the tool's position and of coordinates of "
      "its orientation, both in the world (Siciliano et al., *Robotics*, 2009, section 3.6). "
      "Raises Error for `rpy` at a pitch of +-90 degrees.");
  takes_out(coordinates.choice<OrientationCoordinates>("coordinates", ""))
      .returns("(6, n), or (7, n) for quaternions; (..., 6, n).");
  define(m, &analytical, coordinates, nb::arg("arm"), nb::arg("q"), nb::arg("coordinates"),
         nb::kw_only(), nb::arg("out") = nb::none());

  Signature static_torques =
      row_signature("joint_torques",
                    "Returns the joint torques, N m, and forces, N, that balance a wrench by which "
                    "the tool acts on its surroundings: J^T F (Lynch & Park, eq. 5.26).");
  static_torques.takes("wrench", array_like,
                       "[force moment], N and N m, in the frame's axes: (6,), or (..., 6).");
  takes_out(takes_frame(static_torques)).returns("(n,), or (..., n).");
  define(m, &torques, static_torques, nb::arg("arm"), nb::arg("q"), nb::arg("wrench"),
         nb::arg("frame") = "base", nb::kw_only(), nb::arg("out") = nb::none());
}

}  // namespace

void bind_derivatives(nb::module_& m) {
  bind_jacobians(m);
  Signature dot = row_signature("jacobian_derivative",
                                "Returns the time derivative of the Jacobian, per second "
                                "(Bruyninckx and De Schutter, 1996).");
  takes_out(takes_frame(dot.takes("dq", array_like, velocities_doc)))
      .returns("(6, n), or (..., 6, n).");
  define(m, &derivative, dot, nb::arg("arm"), nb::arg("q"), nb::arg("dq"),
         nb::arg("frame") = "base", nb::kw_only(), nb::arg("out") = nb::none());

  Signature second = row_signature(
      "hessian", "Returns the derivatives of the Jacobian with respect to the coordinates.");
  takes_out(takes_frame(second))
      .returns("(n, 6, n): [k] is the derivative by q[k], per rad or m; or (..., n, 6, n).");
  define(m, &hessian_of, second, nb::arg("arm"), nb::arg("q"), nb::arg("frame") = "base",
         nb::kw_only(), nb::arg("out") = nb::none());

  Signature twist = row_signature("tool_acceleration",
                                  "Returns the time derivative of the velocity J dq: J ddq + dJ/dt "
                                  "dq, [linear angular], m/s^2 and rad/s^2.");
  twist.takes("dq", array_like, velocities_doc)
      .takes("ddq", array_like, "Joint accelerations, rad/s^2 or m/s^2, likewise.");
  takes_out(takes_frame(twist)).returns("(6,), or (..., 6).");
  define(m, &acceleration, twist, nb::arg("arm"), nb::arg("q"), nb::arg("dq"), nb::arg("ddq"),
         nb::arg("frame") = "base", nb::kw_only(), nb::arg("out") = nb::none());
}

}  // namespace beeline::python

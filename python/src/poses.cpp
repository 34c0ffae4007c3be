#include <beeline/pose/so3.h>

#include "bindings.h"
#include "pose_fields.h"

namespace beeline::python {
namespace {

constexpr const char* rotation_like = "A rotation matrix (3, 3), or a pose, whose rotation it is.";
constexpr const char* twist_doc = "[vx vy vz wx wy wz], m and rad, or per second.";

/// A rotation matrix, or the rotation of a pose.
Rotation rotation_from(nb::handle value, const char* name) {
  const nb::object matrix = matrix_of(value);
  const InputArray array(matrix, name);
  const auto shape = array.shape();
  if (!std::ranges::equal(shape, std::array<Index, 2>{3, 3})) {
    if (!std::ranges::equal(shape, std::array<Index, 2>{4, 4})) {
      throw Error(std::string(name) + " has the shape " + shape_text(shape) +
                  "; expected (3, 3) or (4, 4)");
    }
    return Value<Pose>::from(matrix, name).linear();
  }
  Pose pose = Pose::Identity();
  pose.linear() = Value<Rotation>::from(matrix, name);
  return checked_pose(pose, name).linear();
}

Rotation rotation_of_rpy(nb::handle value) {
  if (nb::isinstance<RollPitchYaw>(value)) return rotation(nb::cast<RollPitchYaw>(value));
  const Vector3 angles = finite_from<Vector3>(value, "rpy");
  return rotation(RollPitchYaw{angles[0], angles[1], angles[2]});
}

Rotation rotation_of_quaternion(nb::handle value) {
  if (nb::isinstance<Quaternion>(value)) {
    const Quaternion q = nb::cast<Quaternion>(value);
    return rotation_from_quaternion(q.qw, q.qx, q.qy, q.qz);
  }
  const Eigen::Vector4d q = finite_from<Eigen::Vector4d>(value, "quaternion");
  return rotation_from_quaternion(q[0], q[1], q[2], q[3]);
}

Pose pose_from_parts(nb::handle position, nb::handle matrix, nb::handle rpy, nb::handle quaternion,
                     nb::handle rotation_vector) {
  const int given =
      !matrix.is_none() + !rpy.is_none() + !quaternion.is_none() + !rotation_vector.is_none();
  if (given > 1) {
    throw Error("more than one of rotation, rpy, quaternion and rotation_vector is given");
  }
  Rotation rotation = Rotation::Identity();
  if (!matrix.is_none()) rotation = rotation_from(matrix, "rotation");
  if (!rpy.is_none()) rotation = rotation_of_rpy(rpy);
  if (!quaternion.is_none()) rotation = rotation_of_quaternion(quaternion);
  if (!rotation_vector.is_none()) {
    rotation = so3_exp(finite_from<Vector3>(rotation_vector, "rotation_vector"));
  }
  return checked_pose(make_pose(Value<Vector3>::from(position, "position"), rotation));
}

/// The angles' function, element by element; one of both may be a single number.
nb::object of_angles(double (*function)(double, double), nb::handle left, const char* left_name,
                     nb::handle right, const char* right_name) {
  const InputArray a(left, left_name), b(right, right_name);
  if (a.dimensions() > 0 && b.dimensions() > 0 && !std::ranges::equal(a.shape(), b.shape())) {
    throw Error(std::string(left_name) + " and " + right_name + " have the shapes " +
                shape_text(a.shape()) + " and " + shape_text(b.shape()));
  }
  const InputArray& larger = a.dimensions() > 0 ? a : b;
  if (larger.dimensions() == 0) return nb::float_(function(*a.data(), *b.data()));
  NewArray results(larger.shape());
  for (Index i = 0; i < larger.size(); ++i) {
    results.data()[i] =
        function(a.data()[a.dimensions() > 0 ? i : 0], b.data()[b.dimensions() > 0 ? i : 0]);
  }
  return results.release();
}

void bind_angles(nb::module_& m) {
  constexpr const char* number_or_array = "typing.Any";
  Signature wrap("wrap_angle", number_or_array, comment("wrap_angle"));
  wrap.takes("radians", array_like, "Angle, or an array of them.");
  define(
      m,
      [](nb::handle angle) {
        const auto wrapped = [](double radians, double) { return wrap_angle(radians); };
        return of_angles(wrapped, angle, "radians", nb::float_(0), "radians");
      },
      wrap, nb::arg("radians"));
  Signature difference("angle_difference", number_or_array, comment("angle_difference"));
  difference.takes("a", array_like, "Angle, or an array.").takes("b", array_like, "Likewise.");
  define(
      m, [](nb::handle a, nb::handle b) { return of_angles(&angle_difference, a, "a", b, "b"); },
      difference, nb::arg("a"), nb::arg("b"));
  Signature nearest("nearest_angle", number_or_array, comment("nearest_angle"));
  nearest.takes("radians", array_like, "Angle, or an array.")
      .takes("reference", array_like, "Likewise.");
  define(
      m,
      [](nb::handle angle, nb::handle reference) {
        return of_angles(&nearest_angle, angle, "radians", reference, "reference");
      },
      nearest, nb::arg("radians"), nb::arg("reference"));
}

void bind_orientations(nb::module_& m) {
  Signature made("make_pose", array_type,
                 "Returns the pose with this position and orientation; without an orientation, the "
                 "identity's.");
  const std::string optional = std::string(array_like) + " | None";
  made.takes("position", array_like, "Metres, (3,).")
      .takes("rotation", optional, rotation_like, "None")
      .keywords()
      .takes("rpy", "RollPitchYaw | " + optional, "Roll, pitch, yaw, rad.", "None")
      .takes("quaternion", "Quaternion | " + optional,
             "In the order qw, qx, qy, qz, of length 1 to 1e-3; it is normalised.", "None")
      .takes("rotation_vector", optional, "Unit axis times angle, rad, (3,).", "None")
      .returns("(4, 4).");
  define(
      m,
      [](nb::handle position, nb::handle rotation, nb::handle rpy, nb::handle quaternion,
         nb::handle rotation_vector) {
        return Value<Pose>::to(
            pose_from_parts(position, rotation, rpy, quaternion, rotation_vector));
      },
      made, nb::arg("position"), nb::arg("rotation") = nb::none(), nb::kw_only(),
      nb::arg("rpy") = nb::none(), nb::arg("quaternion") = nb::none(),
      nb::arg("rotation_vector") = nb::none());

  Signature of_rpy("rotation", array_type, "Returns Rz(yaw) Ry(pitch) Rx(roll), (3, 3).");
  of_rpy.takes("rpy", std::string("RollPitchYaw | ") + array_like, "Roll, pitch, yaw, rad.");
  define(
      m, [](nb::handle rpy) { return Value<Rotation>::to(rotation_of_rpy(rpy)); }, of_rpy,
      nb::arg("rpy"));
  Signature rpy("roll_pitch_yaw", "RollPitchYaw",
                "Returns roll, pitch and yaw of a rotation, pitch in [-pi/2, pi/2]. In gimbal "
                "lock, at pitch +-pi/2, roll is 0.");
  rpy.takes("rotation", array_like, rotation_like);
  define(
      m, [](nb::handle rotation) { return roll_pitch_yaw(rotation_from(rotation, "rotation")); },
      rpy, nb::arg("rotation"));
  Signature of_quaternion(
      "rotation_from_quaternion", array_type,
      "Returns the rotation (3, 3) of the quaternion qw + qx i + qy j + qz k, normalised. Raises "
      "Error when its length differs from 1 by more than 1e-3.");
  for (const char* name : {"qw", "qx", "qy", "qz"}) of_quaternion.takes(name, "float");
  define(
      m,
      [](nb::handle qw, nb::handle qx, nb::handle qy, nb::handle qz) {
        return Value<Rotation>::to(
            rotation_from_quaternion(Value<double>::from(qw, "qw"), Value<double>::from(qx, "qx"),
                                     Value<double>::from(qy, "qy"), Value<double>::from(qz, "qz")));
      },
      of_quaternion, nb::arg("qw"), nb::arg("qx"), nb::arg("qy"), nb::arg("qz"));
  Signature q("quaternion", "Quaternion", "Returns the unit quaternion of a rotation, qw >= 0.");
  q.takes("rotation", array_like, rotation_like);
  define(
      m, [](nb::handle rotation) { return quaternion(rotation_from(rotation, "rotation")); }, q,
      nb::arg("rotation"));
}

/// Adds a function of one vector, or of one rotation or pose.
template <class Evaluate>
void one_argument(nb::module_& m, const char* name, const char* summary, const char* argument,
                  const char* doc, Evaluate evaluate) {
  Signature signature(name, array_type, summary);
  signature.takes(argument, array_like, doc);
  define(m, evaluate, signature, nb::arg(argument));
}

void bind_rotations(nb::module_& m) {
  const char* vector = "Unit axis times angle, rad, (3,).";
  const auto of_vector = [&](const char* name, const char* summary, auto function) {
    one_argument(m, name, summary, "rotation_vector", vector, [function](nb::handle value) {
      return Value<Eigen::Matrix3d>::to(function(finite_from<Vector3>(value, "rotation_vector")));
    });
  };
  of_vector("hat", "Returns the skew-symmetric matrix of the cross product, (3, 3).", &hat);
  of_vector("so3_exp",
            "Returns the rotation (3, 3) of a rotation vector, by Rodrigues' formula (Lynch & "
            "Park, *Modern Robotics*, 2017, eq. 3.51).",
            &so3_exp);
  of_vector("so3_left_jacobian",
            "Returns the left Jacobian J (3, 3) of SO(3): the angular velocity of so3_exp(r) is "
            "J(r) dr/dt (Chirikjian, 2011, eq. 10.86).",
            &so3_left_jacobian);
  of_vector("so3_left_jacobian_inverse",
            "Returns the inverse (3, 3) of so3_left_jacobian(), for angles below 2 pi.",
            &so3_left_jacobian_inverse);
  one_argument(m, "so3_log", "Returns the shortest rotation vector (3,) of a rotation.", "rotation",
               rotation_like, [](nb::handle value) {
                 return Value<Vector3>::to(so3_log(rotation_from(value, "rotation")));
               });
}

nb::object interpolated(nb::handle from, nb::handle to, nb::handle fraction) {
  const Pose first = Value<Pose>::from(from, "start"), last = Value<Pose>::from(to, "end");
  const InputArray s(fraction, "s");
  std::vector<Index> shape(s.shape().begin(), s.shape().end());
  shape.insert(shape.end(), {4, 4});
  NewArray poses(shape);
  for (Index i = 0; i < s.size(); ++i) {
    if (!std::isfinite(s.data()[i])) throw Error("s has a value that is not finite");
    write_pose(interpolate(first, last, s.data()[i]), poses.data() + 16 * i);
  }
  return poses.release();
}

void bind_motions(nb::module_& m) {
  one_argument(m, "se3_exp",
               "Returns the motion (4, 4) by a constant twist for unit time (Lynch & Park, eq. "
               "3.88, there with the angular part first).",
               "twist", twist_doc, [](nb::handle value) {
                 return Value<Pose>::to(se3_exp(finite_from<Twist>(value, "twist")));
               });
  one_argument(m, "se3_log",
               "Returns the twist (6,) whose exponential is the pose, its rotation by at most pi.",
               "pose", pose_doc, [](nb::handle value) {
                 return Value<Twist>::to(se3_log(Value<Pose>::from(value, "pose")));
               });
  one_argument(
      m, "inverse", "Returns the inverse (4, 4) of a pose.", "pose", pose_doc,
      [](nb::handle value) { return Value<Pose>::to(Value<Pose>::from(value, "pose").inverse()); });
  one_argument(m, "checked_pose",
               "Returns the pose with its rotation orthonormal to rounding. Raises Error for a "
               "matrix that is not a rigid motion to 1e-6, with the reason.",
               "pose", pose_doc,
               [](nb::handle value) { return Value<Pose>::to(Value<Pose>::from(value, "pose")); });
  Signature ad("adjoint", array_type,
               "Returns the adjoint Ad(a_T_b) (6, 6), which maps a twist in frame b to the same "
               "twist in frame a; or, given one, that twist (6,).");
  ad.takes("pose", array_like, pose_doc)
      .takes("twist", std::string(array_like) + " | None", twist_doc, "None");
  define(
      m,
      [](nb::handle pose, nb::handle twist) {
        const Pose a_T_b = Value<Pose>::from(pose, "pose");
        if (twist.is_none()) return Value<Matrix6>::to(adjoint(a_T_b));
        return Value<Twist>::to(adjoint(a_T_b, finite_from<Twist>(twist, "twist")));
      },
      ad, nb::arg("pose"), nb::arg("twist") = nb::none());
  Signature line(
      "interpolate", array_type,
      "Returns poses on the straight line from `start` (s = 0) to `end` (s = 1): the position "
      "moves at constant velocity, the orientation about a fixed axis, by at most pi.");
  line.takes("start", array_like, pose_doc)
      .takes("end", array_like, pose_doc)
      .takes("s", array_like, "A number, or an array of them.")
      .returns("(4, 4), or (..., 4, 4).");
  define(m, &interpolated, line, nb::arg("start"), nb::arg("end"), nb::arg("s"));
  Signature difference(
      "pose_difference", array_type,
      "Returns the difference of two poses of one frame, in that frame's axes: [p_to - p_from; "
      "log(R_to R_from^T)], (6,); of two Pose2 [dx dy dtheta], (3,).");
  difference.takes("to", std::string("Pose2 | ") + array_like, pose_doc)
      .takes("start", std::string("Pose2 | ") + array_like, pose_doc);
  define(
      m,
      [](nb::handle to, nb::handle start) {
        if (nb::isinstance<Pose2>(to) && nb::isinstance<Pose2>(start)) {
          return Value<Twist2>::to(pose_difference(nb::cast<Pose2>(to), nb::cast<Pose2>(start)));
        }
        return Value<Twist>::to(
            pose_difference(Value<Pose>::from(to, "to"), Value<Pose>::from(start, "start")));
      },
      difference, nb::arg("to"), nb::arg("start"));
}

}  // namespace

void bind_poses(nb::module_& m) {
  m.def("_matrix_of", &matrix_of, nb::arg().none());  // for poses.py
  bind_numbers(bind_record<RollPitchYaw>(m));
  bind_numbers(bind_record<Quaternion>(m));
  bind_angles(m);
  bind_orientations(m);
  bind_rotations(m);
  bind_motions(m);
  bind_planar_poses(m);
}

}  // namespace beeline::python

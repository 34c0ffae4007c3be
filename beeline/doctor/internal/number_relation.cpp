#include <array>
#include <cmath>
#include <numbers>

#include <beeline/doctor/internal/number_relation.h>
#include <beeline/error.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

using std::numbers::pi;

bool near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

/// Whether b is `factor` times a, to six digits.
bool scaled(double a, double b, double factor) {
  return std::abs(a) > 1e-9 && near(b, factor * a, 1e-6 * std::abs(b));
}

bool same_angle(double a, double b) { return near(wrap_angle(a - b), 0, 1e-6); }

Rotation about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix();
}

/// The number cut off after this many significant digits.
double cut_off(double value, int digits) {
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return std::trunc(value / unit) * unit;
}

}  // namespace

std::string length_relation(double in_a, double in_b) {
  if (scaled(in_a, in_b, -1)) return "the other sign";
  if (scaled(in_a, in_b, 1000)) return "millimetres in B";
  if (scaled(in_a, in_b, 1e-3)) return "millimetres in A";
  if (scaled(in_a, in_b, 100)) return "centimetres in B";
  if (scaled(in_a, in_b, 1e-2)) return "centimetres in A";
  if (scaled(in_a, in_b, 1 / 0.0254)) return "inches in B";
  if (scaled(in_a, in_b, 0.0254)) return "inches in A";
  if (scaled(in_a, in_b, 10) || scaled(in_a, in_b, 0.1)) return "a decimal point moved";
  return "";
}

std::string angle_relation(double in_a, double in_b) {
  const std::string truncated = truncated_right_angle(in_b);
  const std::string truncated_a = truncated_right_angle(in_a);
  if (std::abs(wrap_angle(in_a - in_b)) < 0.01) {
    if (!truncated.empty()) return truncated + " in B";
    if (!truncated_a.empty()) return truncated_a + " in A";
  }
  if (same_angle(in_a, -in_b)) return "the other sign";
  if (same_angle(in_b, in_a * 180 / pi)) return "degrees read as radians in B";
  if (same_angle(in_a, in_b * 180 / pi)) return "degrees read as radians in A";
  if (same_angle(in_b, in_a * pi / 180)) return "radians taken for degrees in B";
  if (same_angle(in_a, in_b * pi / 180)) return "radians taken for degrees in A";
  return "";
}

std::string truncated_right_angle(double angle, double* nearest) {
  const double step = pi / 2;
  const double multiple = std::round(angle / step);
  if (multiple == 0 || std::abs(multiple) > 4) return "";
  const double exact = multiple * step;
  if (nearest != nullptr) *nearest = exact;
  for (int digits = 3; digits <= 10; ++digits) {
    const double unit = 1e-13;
    if (!near(angle, rounded(exact, digits), unit) && !near(angle, cut_off(exact, digits), unit)) {
      continue;
    }
    const double size = std::abs(multiple);
    const std::string name = size == 1 ? "pi/2" : size == 2 ? "pi" : size == 3 ? "3 pi/2" : "2 pi";
    return (multiple < 0 ? "-" : "") + name + " with " + std::to_string(digits) + " digits";
  }
  return "";
}

MistakenRotation mistaken_rotation(const Rotation& right, int k, bool second) {
  const RollPitchYaw rpy = roll_pitch_yaw(right);
  double r = rpy.roll, p = rpy.pitch, y = rpy.yaw;
  if (second) {
    r += pi;
    p = pi - p;
    y += pi;
  }
  constexpr double degrees = 180 / pi;
  switch (k) {
    case 0:
      return {"roll, pitch, yaw about moving axes", about(0, r) * about(1, p) * about(2, y)};
    case 1:
      return {"yaw, pitch, roll in the places of roll, pitch, yaw",
              about(2, r) * about(1, p) * about(0, y)};
    case 2:
      return {"degrees read as radians",
              about(2, y * degrees) * about(1, p * degrees) * about(0, r * degrees)};
    case 3:
      return {"the inverse rotation", right.transpose()};
    case 4: {
      const Quaternion q = quaternion(right);
      return {"a quaternion with qw last read as with qw first",
              rotation_from_quaternion(q.qx, q.qy, q.qz, q.qw)};
    }
    case 5: {
      const Quaternion q = quaternion(right);
      return {"a quaternion with qw first read as with qw last",
              rotation_from_quaternion(q.qz, q.qw, q.qx, q.qy)};
    }
    case 6:
      return {"roll and pitch exchanged", about(2, y) * about(1, r) * about(0, p)};
    default:
      return {"pitch and yaw exchanged", about(2, p) * about(1, y) * about(0, r)};
  }
}

std::string rotation_relation(const Rotation& in_a, const Rotation& in_b) {
  constexpr double tolerance = 1e-3;  // tolerance for numbers that may be rounded degrees
  if (in_b.isIdentity(tolerance)) return "left out in B";
  if (in_a.isIdentity(tolerance)) return "left out in A";
  for (int k = 0; k < mistaken_rotations; ++k) {
    for (const bool second : {false, true}) {
      const MistakenRotation of_a = mistaken_rotation(in_a, k, second);
      if ((of_a.rotation - in_b).isZero(tolerance)) return of_a.mistake + " in B";
      const MistakenRotation of_b = mistaken_rotation(in_b, k, second);
      if ((of_b.rotation - in_a).isZero(tolerance)) return of_b.mistake + " in A";
    }
  }
  return "";
}

}  // namespace beeline::internal

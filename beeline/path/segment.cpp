#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/path/segment.h>
#include <beeline/pose/internal/rotation_rates.h>

namespace beeline {
namespace {

Twist joined(const Vector3& linear, const Vector3& angular) {
  Twist twist;
  twist << linear, angular;
  return twist;
}

/// A motion whose orientation follows the shortest rotation at a constant rate.
PoseMotion rotating_motion(const Pose& from, const Pose& to, double s, const Vector3& velocity,
                           const Vector3& acceleration) {
  return {interpolate(from, to, s), joined(velocity, pose_difference(to, from).tail<3>()),
          joined(acceleration, Vector3::Zero())};
}

PoseMotion motion(const Line& line, double s) {
  return rotating_motion(line.from, line.to, s, line.to.translation() - line.from.translation(),
                         Vector3::Zero());
}

PoseMotion motion(const ScrewLine& screw, double s) {
  const Twist body = se3_log(screw.from.inverse() * screw.to);
  const Pose pose = screw.from * se3_exp(s * body);
  const Vector3 velocity = pose.linear() * body.head<3>();
  const Vector3 rotation = screw.from.linear() * body.tail<3>();
  return {pose, joined(velocity, rotation), joined(rotation.cross(velocity), Vector3::Zero())};
}

PoseMotion motion(const Arc& arc, double s) {
  // (exp(s rotation) - 1) times the radius, without cancellation where the centre is far away.
  const Vector3 radius = arc.from.translation() - arc.centre;
  const double angle = arc.rotation.norm(), half = std::sin(s * angle / 2);
  const Vector3 axis = arc.rotation / angle, across = axis.cross(radius);
  const Vector3 moved = std::sin(s * angle) * across + 2 * half * half * axis.cross(across);
  const Vector3 velocity = arc.rotation.cross(radius + moved);
  PoseMotion at = rotating_motion(arc.from, arc.to, s, velocity, arc.rotation.cross(velocity));
  at.pose.translation() = arc.from.translation() + moved;
  return at;
}

PoseMotion motion(const SplineSegment& segment, double s) {
  Twist value = Twist::Zero(), rate = Twist::Zero(), half_second = Twist::Zero();
  for (int k = 5; k >= 0; --k) {  // Horner's scheme
    half_second = half_second * s + rate;
    rate = rate * s + value;
    value = value * s + segment.terms.col(k);
  }
  const Vector3 r = value.tail<3>();
  const internal::RotationRates turning =
      internal::angular_motion(r, {rate.tail<3>(), 2 * half_second.tail<3>()});
  PoseMotion at{segment.centre, joined(rate.head<3>(), turning.velocity),
                joined(2 * half_second.head<3>(), turning.acceleration)};
  at.pose.translation() += value.head<3>();
  at.pose.linear() = so3_exp(r) * segment.centre.linear();
  return at;
}

Segment back(const Line& line) { return Line{line.to, line.from}; }
Segment back(const ScrewLine& screw) { return ScrewLine{screw.to, screw.from}; }
Segment back(const Arc& arc) { return Arc{arc.to, arc.from, arc.centre, -arc.rotation}; }

/// The polynomial in 1 - s.
Segment back(const SplineSegment& segment) {
  SplineSegment other{segment.centre};
  for (int k = 5; k >= 0; --k) {  // Horner's scheme in the polynomial 1 - s
    Matrix6 next = other.terms;
    next.rightCols<5>() -= other.terms.leftCols<5>();
    other.terms = next;
    other.terms.col(0) += segment.terms.col(k);
  }
  return other;
}

}  // namespace

Segment reversed(const Segment& segment) {
  return std::visit([](const auto& kind) { return back(kind); }, segment);
}

Arc arc_through(const Pose& from, const Vector3& passed, const Pose& to) {
  constexpr double flattest = 1e-6;  // beyond, the radius has less than six correct digits
  const Vector3 a = passed - from.translation(), b = to.translation() - from.translation();
  const Vector3 normal = a.cross(b);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  if (!(normal.norm() > flattest * longest)) {
    throw Error(
        "the arc's three positions lie on a straight line, or two of them coincide: they determine "
        "no circle");
  }
  const Vector3 radius = normal.cross(a.squaredNorm() * b - b.squaredNorm() * a) /
                         (2 * normal.squaredNorm());  // from the centre to `from`
  const Vector3 axis = normal.normalized(), at_end = radius + b;
  double angle = std::atan2(axis.dot(radius.cross(at_end)), radius.dot(at_end));
  if (angle <= 0) angle += 2 * std::numbers::pi;
  return {from, to, from.translation() - radius, angle * axis};
}

Pose pose_at(const Segment& segment, double s) {
  if (const auto* line = std::get_if<Line>(&segment)) return interpolate(line->from, line->to, s);
  return motion_at(segment, s).pose;
}

PoseMotion motion_at(const Segment& segment, double s) {
  return std::visit([s](const auto& kind) { return motion(kind, s); }, segment);
}

double length_of(const Segment& segment) {
  const auto speed = [&segment](double s) {
    return motion_at(segment, s).velocity.head<3>().norm();
  };
  if (!std::holds_alternative<SplineSegment>(segment)) return speed(0);
  constexpr int parts = 16;  // of 5 points each
  constexpr std::array<double, 3> node{0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight{0.5688888888888889, 0.4786286704993665,
                                         0.2369268850561891};
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double middle = (i + 0.5) / parts, half = 0.5 / parts;
    sum += weight[0] * speed(middle);
    for (std::size_t k = 1; k < node.size(); ++k) {
      sum += weight[k] * (speed(middle - half * node[k]) + speed(middle + half * node[k]));
    }
  }
  return sum / (2 * parts);
}

bool rotates_about_z(const Segment& segment) {
  constexpr double tilt = 1e-9;
  if (const auto* spline = std::get_if<SplineSegment>(&segment)) {
    return spline->terms.middleRows<2>(3).cwiseAbs().maxCoeff() <= tilt;
  }
  return motion_at(segment, 0).velocity.segment<2>(3).cwiseAbs().maxCoeff() <= tilt;
}

}  // namespace beeline

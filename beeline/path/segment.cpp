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

/// A motion whose orientation takes the shortest turn at a constant rate.
PieceMotion turning_motion(const Pose& from, const Pose& to, double s, const Vector3& velocity,
                           const Vector3& acceleration) {
  return {interpolate(from, to, s), joined(velocity, pose_difference(to, from).tail<3>()),
          joined(acceleration, Vector3::Zero())};
}

PieceMotion motion(const Line& line, double s) {
  return turning_motion(line.from, line.to, s, line.to.translation() - line.from.translation(),
                        Vector3::Zero());
}

PieceMotion motion(const ScrewLine& screw, double s) {
  const Twist body = se3_log(screw.from.inverse() * screw.to);
  const Pose pose = screw.from * se3_exp(s * body);
  const Vector3 velocity = pose.linear() * body.head<3>();
  const Vector3 turn = screw.from.linear() * body.tail<3>();
  return {pose, joined(velocity, turn), joined(turn.cross(velocity), Vector3::Zero())};
}

PieceMotion motion(const Arc& arc, double s) {
  // (exp(s turn) - 1) times the radius: no digits are lost where the centre is far away
  const Vector3 radius = arc.from.translation() - arc.centre;
  const double angle = arc.turn.norm(), half = std::sin(s * angle / 2);
  const Vector3 axis = arc.turn / angle, across = axis.cross(radius);
  const Vector3 moved = std::sin(s * angle) * across + 2 * half * half * axis.cross(across);
  const Vector3 velocity = arc.turn.cross(radius + moved);
  PieceMotion at = turning_motion(arc.from, arc.to, s, velocity, arc.turn.cross(velocity));
  at.pose.translation() = arc.from.translation() + moved;
  return at;
}

PieceMotion motion(const SplinePiece& piece, double s) {
  Twist value = Twist::Zero(), rate = Twist::Zero(), half_second = Twist::Zero();
  for (int k = 5; k >= 0; --k) {  // Horner
    half_second = half_second * s + rate;
    rate = rate * s + value;
    value = value * s + piece.terms.col(k);
  }
  const Vector3 r = value.tail<3>();
  const Turning turning = angular_motion(r, {rate.tail<3>(), 2 * half_second.tail<3>()});
  PieceMotion at{piece.centre, joined(rate.head<3>(), turning.velocity),
                 joined(2 * half_second.head<3>(), turning.acceleration)};
  at.pose.translation() += value.head<3>();
  at.pose.linear() = so3_exp(r) * piece.centre.linear();
  return at;
}

Piece back(const Line& line) { return Line{line.to, line.from}; }
Piece back(const ScrewLine& screw) { return ScrewLine{screw.to, screw.from}; }
Piece back(const Arc& arc) { return Arc{arc.to, arc.from, arc.centre, -arc.turn}; }

/// The polynomial at 1 - s.
Piece back(const SplinePiece& piece) {
  SplinePiece other{piece.centre};
  for (int k = 5; k >= 0; --k) {  // Horner, by the polynomial 1 - s
    Matrix6 next = other.terms;
    next.rightCols<5>() -= other.terms.leftCols<5>();
    other.terms = next;
    other.terms.col(0) += piece.terms.col(k);
  }
  return other;
}

}  // namespace

Piece reversed(const Piece& piece) {
  return std::visit([](const auto& kind) { return back(kind); }, piece);
}

Arc arc_through(const Pose& from, const Vector3& passed, const Pose& to) {
  constexpr double flattest = 1e-6;
  const Vector3 a = passed - from.translation(), b = to.translation() - from.translation();
  const Vector3 normal = a.cross(b);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  if (!(normal.norm() > flattest * longest)) {
    throw Error(
        "the arc's three positions lie on a straight line, or two of them are one: they tell no "
        "circle");
  }
  const Vector3 radius = normal.cross(a.squaredNorm() * b - b.squaredNorm() * a) /
                         (2 * normal.squaredNorm());  // from the centre to `from`
  const Vector3 axis = normal.normalized(), at_end = radius + b;
  double angle = std::atan2(axis.dot(radius.cross(at_end)), radius.dot(at_end));
  if (angle <= 0) angle += 2 * std::numbers::pi;
  return {from, to, from.translation() - radius, angle * axis};
}

Pose pose_at(const Piece& piece, double s) {
  if (const auto* line = std::get_if<Line>(&piece)) return interpolate(line->from, line->to, s);
  return motion_at(piece, s).pose;
}

PieceMotion motion_at(const Piece& piece, double s) {
  return std::visit([s](const auto& kind) { return motion(kind, s); }, piece);
}

double length_of(const Piece& piece) {
  const auto speed = [&piece](double s) { return motion_at(piece, s).velocity.head<3>().norm(); };
  if (!std::holds_alternative<SplinePiece>(piece)) return speed(0);
  constexpr int parts = 16;
  constexpr std::array<double, 3> place{0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weight{0.5688888888888889, 0.4786286704993665,
                                         0.2369268850561891};
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double middle = (i + 0.5) / parts, half = 0.5 / parts;
    sum += weight[0] * speed(middle);
    for (std::size_t k = 1; k < place.size(); ++k) {
      sum += weight[k] * (speed(middle - half * place[k]) + speed(middle + half * place[k]));
    }
  }
  return sum / (2 * parts);
}

bool turns_about_z(const Piece& piece) {
  constexpr double tilt = 1e-9;
  if (const auto* spline = std::get_if<SplinePiece>(&piece)) {
    return spline->terms.middleRows<2>(3).cwiseAbs().maxCoeff() <= tilt;
  }
  return motion_at(piece, 0).velocity.segment<2>(3).cwiseAbs().maxCoeff() <= tilt;
}

}  // namespace beeline

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/orientation_gap.h>
#include <beeline/certificate/internal/segment_chord_bound.h>
#include <beeline/pose/internal/rotation_rates.h>

namespace beeline::internal {
namespace {

/// Returns the maximum of |d| over t in [0, 1] for d'' = 1 - 2 t and d(0) = d(1) = 0:
/// d = -t (1 - t)(1 - 2 t) / 6.
constexpr double linear_term_maximum = 1 / (36 * std::numbers::sqrt3);

SegmentChordBound bound_of(const Line& line, double s_a, double s_b) {
  SegmentChordBound bound;
  bound.rotation = std::abs(s_b - s_a) * pose_difference(line.to, line.from).tail<3>().norm();
  return bound;
}

/// An arc of radius 1 and angle f has at the fraction t the squared distance from its chord
///     g(x) = |exp(ix) - cos h - i (x/h) sin h|^2,   h = f/2, x = f (t - 1/2).
/// With k = sin(h)/h and 0 <= x <= h <= pi
///     g'/2 = (cos h - k) sin x + k x (k - cos x) <= (k x - sin x)(k - cos x),
/// with cos h <= k and k x <= sin x. If k <= cos x, the left side is not positive; otherwise the
/// right side is not. Hence the distance is largest at t = 1/2.
SegmentChordBound circle_bound(const PoseMotion& middle, const Vector3& rotation, double step) {
  const double size = middle.acceleration.head<3>().norm() * step * step;  // r f^2
  const double angle = rotation.norm() * std::abs(step);
  const double sinc = angle > 1e-8 ? std::sin(angle / 4) / (angle / 4) : 1;
  SegmentChordBound bound;
  bound.rotation = middle.velocity.tail<3>().norm() * std::abs(step);
  bound.position = size / 8 * sinc * sinc;
  bound.curvature_term = middle.acceleration.head<3>() * step * step / 8;
  // p'' rotates by f (t - 1/2): a linear term, and a quadratic remainder.
  bound.remainder =
      size * std::min(angle / 48, angle / 2 * linear_term_maximum + angle * angle / 64);
  return bound;
}

SegmentChordBound bound_of(const ScrewLine& screw, double s_a, double s_b) {
  const PoseMotion middle = motion_at(screw, (s_a + s_b) / 2);
  return circle_bound(middle, middle.velocity.tail<3>(), s_b - s_a);
}

SegmentChordBound bound_of(const Arc& arc, double s_a, double s_b) {
  return circle_bound(motion_at(arc, (s_a + s_b) / 2), arc.rotation, s_b - s_a);
}

/// The polynomial [x; r] and its five derivatives at s.
std::array<Twist, 6> derivatives(const SplineSegment& segment, double s) {
  std::array<Twist, 6> d;
  d.fill(Twist::Zero());
  for (int k = 5; k >= 0; --k) {
    for (std::size_t i = 5; i > 0; --i) d[i] = d[i] * s + d[i - 1];
    d[0] = d[0] * s + segment.terms.col(k);
  }
  double factorial = 1;
  for (std::size_t i = 2; i < d.size(); ++i) d[i] *= factorial *= static_cast<double>(i);
  return d;
}

SegmentChordBound bound_of(const SplineSegment& segment, double s_a, double s_b) {
  const std::array<Twist, 6> d = derivatives(segment, (s_a + s_b) / 2);
  const double step = std::abs(s_b - s_a), half = step / 2, square = step * step;
  std::array<double, 6> x{}, r{};
  for (std::size_t i = 0; i < d.size(); ++i) {
    x[i] = d[i].head<3>().norm();
    r[i] = d[i].tail<3>().norm();
  }
  // Taylor remainder of the second derivative after its linear term.
  const auto second_remainder = [half](const std::array<double, 6>& size) {
    return half * half / 2 * (size[4] + half / 3 * size[5]);
  };
  SegmentChordBound bound;
  bound.curvature_term = square / 8 * d[2].head<3>();
  bound.remainder = square * (half * x[3] * linear_term_maximum + second_remainder(x) / 8);
  bound.position = bound.curvature_term.norm() + bound.remainder;

  const double second = r[2] + half * r[3] + second_remainder(r);  // maxima over the step of |r''|,
  const double rate = r[1] + half * second;                        // |r'|,
  const double size = r[0] + half * rate;                          // |r| and |r x r'|
  const double across = d[0].tail<3>().cross(d[1].tail<3>()).norm() + half * size * second;
  bound.rotation = step * rate;
  bound.orientation = orientation_gap(
      square * (r[2] + second_remainder(r) + across * rate / 6) + square * step * r[3] / 6,
      bound.rotation);
  const double third = r[3] + half * r[4] + half * half / 2 * r[5];
  bound.angular_acceleration =
      square * angular_motion(d[0].tail<3>(), {d[1].tail<3>(), d[2].tail<3>()}).acceleration;
  bound.angular_remainder =
      square * step / 6 * (third + 1.5 * rate * second + rate * rate * rate / 3);
  return bound;
}

}  // namespace

SegmentChordBound segment_chord_bound(const Segment& segment, double s_a, double s_b) {
  return std::visit([=](const auto& kind) { return bound_of(kind, s_a, s_b); }, segment);
}

}  // namespace beeline::internal

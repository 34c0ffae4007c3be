#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/certificate/internal/segment_chord.h>
#include <beeline/pose/internal/rotation_rates.h>

namespace beeline {
namespace {

/// t(1 - t)(1 - 2t)/6 is that at most: what d'' = 1 - 2t makes of d.
constexpr double odd_share = 1 / (36 * std::numbers::sqrt3);

SegmentChordBound off(const Line& line, double s_a, double s_b) {
  SegmentChordBound bound;
  bound.turned = std::abs(s_b - s_a) * pose_difference(line.to, line.from).tail<3>().norm();
  return bound;
}

/// The arc's distance from its chord at the share t has the square g(x) = |exp(ix) - cos h -
/// i (x/h) sin h|^2 with h = f/2, x = f(t - 1/2); with k = sin(h)/h it is
///     g'/2 = (cos h - k) sin x + k x (k - cos x) <= (k x - sin x)(k - cos x),  0 <= x <= h <= pi,
/// where cos h <= k and k x <= sin x: negative by the left side where k <= cos x, else by the
/// right. So it is largest half-way.
SegmentChordBound off_circle(const SegmentMotion& middle, const Vector3& turn, double step) {
  const double size = middle.acceleration.head<3>().norm() * step * step;  // r f^2
  const double angle = turn.norm() * std::abs(step);
  const double sinc = angle > 1e-8 ? std::sin(angle / 4) / (angle / 4) : 1;
  SegmentChordBound bound;
  bound.turned = middle.velocity.tail<3>().norm() * std::abs(step);
  bound.position = size / 8 * sinc * sinc;
  bound.bend = middle.acceleration.head<3>() * step * step / 8;
  // p'' turns by the angle f: by f (t - 1/2), but for the square of that
  bound.rest = size * std::min(angle / 48, angle / 2 * odd_share + angle * angle / 64);
  return bound;
}

SegmentChordBound off(const ScrewLine& screw, double s_a, double s_b) {
  const SegmentMotion middle = motion_at(screw, (s_a + s_b) / 2);
  return off_circle(middle, middle.velocity.tail<3>(), s_b - s_a);
}

SegmentChordBound off(const Arc& arc, double s_a, double s_b) {
  return off_circle(motion_at(arc, (s_a + s_b) / 2), arc.turn, s_b - s_a);
}

/// Derivatives of the polynomial, the value first.
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

SegmentChordBound off(const SplineSegment& segment, double s_a, double s_b) {
  const std::array<Twist, 6> d = derivatives(segment, (s_a + s_b) / 2);
  const double step = std::abs(s_b - s_a), half = step / 2, square = step * step;
  std::array<double, 6> x{}, r{};
  for (std::size_t i = 0; i < d.size(); ++i) {
    x[i] = d[i].head<3>().norm();
    r[i] = d[i].tail<3>().norm();
  }
  // what the second derivative has besides its value and its change in the middle
  const auto curved = [half](const std::array<double, 6>& size) {
    return half * half / 2 * (size[4] + half / 3 * size[5]);
  };
  SegmentChordBound bound;
  bound.bend = square / 8 * d[2].head<3>();
  bound.rest = square * (half * x[3] * odd_share + curved(x) / 8);
  bound.position = bound.bend.norm() + bound.rest;

  const double second = r[2] + half * r[3] + curved(r);  // the most on the way, of |r''|,
  const double rate = r[1] + half * second;              // |r'|,
  const double size = r[0] + half * rate;                // |r| and |r x r'|
  const double across = d[0].tail<3>().cross(d[1].tail<3>()).norm() + half * size * second;
  bound.turned = step * rate;
  bound.orientation = orientation_bound(
      square * (r[2] + curved(r) + across * rate / 6) + square * step * r[3] / 6, bound.turned);
  const double third = r[3] + half * r[4] + half * half / 2 * r[5];
  bound.swing =
      square * internal::angular_motion(d[0].tail<3>(), {d[1].tail<3>(), d[2].tail<3>()}).acceleration;
  bound.swing_rest = square * step / 6 * (third + 1.5 * rate * second + rate * rate * rate / 3);
  return bound;
}

}  // namespace

SegmentChordBound segment_chord_bound(const Segment& segment, double s_a, double s_b) {
  return std::visit([=](const auto& kind) { return off(kind, s_a, s_b); }, segment);
}

}  // namespace beeline

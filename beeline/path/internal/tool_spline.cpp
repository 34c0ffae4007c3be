#include <cmath>

#include <beeline/path/internal/tool_spline.h>
#include <beeline/pose/internal/rotation_rates.h>

namespace beeline {
namespace {

/// What leads from each knot to the next, position and turn, over which span of the parameter.
struct Steps {
  std::vector<Twist> way;
  std::vector<double> span;
};

Steps steps_between(std::span<const Pose> poses) {
  Steps steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Twist way = pose_difference(poses[i], poses[i - 1]);
    steps.way.push_back(way);
    steps.span.push_back(
        std::hypot(way.head<3>().norm(), metres_per_radian * way.tail<3>().norm()));
  }
  return steps;
}

/// The cubic spline's slopes at the knots (de Boor, "A Practical Guide to Splines", ch. IV): its
/// three diagonals are solved from the first row on, and back.
std::vector<Twist> slopes_of(const Steps& steps, const SplineEnds& ends) {
  const std::size_t last = steps.way.size();
  const auto weight = [&](std::size_t i) { return 1 / steps.span[i]; };
  const auto pull = [&](std::size_t i) -> Twist {
    return 3 * weight(i) * weight(i) * steps.way[i];
  };
  std::vector<double> diagonal(last + 1), above(last + 1);
  std::vector<Twist> slopes(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const auto& given = i == 0 ? ends.first : ends.last;
    const bool end = i == 0 || i == last;
    diagonal[i] = end && given ? 1 : 0;
    double below = 0;
    slopes[i] = end && given ? *given : Twist(Twist::Zero());
    if (!(end && given)) {
      if (i > 0) below = weight(i - 1), diagonal[i] += 2 * below, slopes[i] += pull(i - 1);
      if (i < last) above[i] = weight(i), diagonal[i] += 2 * above[i], slopes[i] += pull(i);
    }
    if (i == 0) continue;
    const double share = below / diagonal[i - 1];
    diagonal[i] -= share * above[i - 1];
    slopes[i] -= share * slopes[i - 1];
  }
  slopes[last] /= diagonal[last];
  for (std::size_t i = last; i-- > 0;)
    slopes[i] = (slopes[i] - above[i] * slopes[i + 1]) / diagonal[i];
  return slopes;
}

/// The polynomial with these values, first and second derivatives at 0 and 1 (Hermite's).
Eigen::Matrix<double, 3, 6> quintic(const Vector3& from, const internal::RotationRates& at_from,
                                    const Vector3& to, const internal::RotationRates& at_to) {
  const Vector3 half = at_from.acceleration / 2;
  const Vector3 d = to - from - at_from.velocity - half;
  const Vector3 e = at_to.velocity - at_from.velocity - at_from.acceleration;
  const Vector3 f = at_to.acceleration - at_from.acceleration;
  Eigen::Matrix<double, 3, 6> terms;
  terms << from, at_from.velocity, half, 10 * d - 4 * e + f / 2, -15 * d + 7 * e - f,
      6 * d - 3 * e + f / 2;
  return terms;
}

/// From `from` on, with velocities at both ends; all by s.
SplineSegment segment_of(const Pose& from, const Twist& way, const Twist& at_from,
                         const Twist& at_to) {
  const Twist second_from = 6 * way - 4 * at_from - 2 * at_to;  // the cubic's
  const Twist second_to = -6 * way + 2 * at_from + 4 * at_to;
  SplineSegment segment;
  segment.terms.col(1) = at_from;
  segment.terms.col(2) = second_from / 2;
  segment.terms.col(3) = (second_to - second_from) / 6;
  const Vector3 turn = way.tail<3>() / 2;
  const auto rates = [](const Vector3& r, const Twist& first, const Twist& second) {
    return internal::rotation_vector_rates(r, {first.tail<3>(), second.tail<3>()});
  };
  segment.terms.bottomRows<3>() =
      quintic(-turn, rates(-turn, at_from, second_from), turn, rates(turn, at_to, second_to));
  segment.centre = from;
  segment.centre.linear() = so3_exp(turn) * from.linear();
  return segment;
}

}  // namespace

ToolPath spline_through(std::span<const Pose> poses, const SplineEnds& ends) {
  const Steps steps = steps_between(poses);
  const std::vector<Twist> slopes = slopes_of(steps, ends);
  ToolPath path;
  for (std::size_t i = 0; i < steps.way.size(); ++i) {
    const double span = steps.span[i];
    path.segments.emplace_back(
        segment_of(poses[i], steps.way[i], span * slopes[i], span * slopes[i + 1]));
    path.spans.push_back(span);
  }
  return path;
}

}  // namespace beeline

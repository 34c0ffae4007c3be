#include <cmath>

#include <beeline/math/hermite.h>
#include <beeline/path/internal/tool_spline.h>
#include <beeline/pose/internal/rotation_rates.h>

namespace beeline::internal {
namespace {

/// A spline turns back at a knot where its speed with respect to the chord length is less.
constexpr double min_spline_speed = 0.03;

/// The translation and rotation vector from each knot to the next, and the span of the parameter.
struct Steps {
  std::vector<Twist> motion;
  std::vector<double> span;
};

Steps steps_between(std::span<const Pose> poses) {
  Steps steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Twist motion = pose_difference(poses[i], poses[i - 1]);
    steps.motion.push_back(motion);
    steps.span.push_back(
        std::hypot(motion.head<3>().norm(), metres_per_radian * motion.tail<3>().norm()));
  }
  return steps;
}

/// The derivatives of the cubic spline at the knots (de Boor, *A Practical Guide to Splines*,
/// chapter IV): solves its tridiagonal system by elimination and back substitution.
std::vector<Twist> slopes_of(const Steps& steps, const SplineEnds& ends) {
  const std::size_t last = steps.motion.size();
  const auto weight = [&](std::size_t i) { return 1 / steps.span[i]; };
  const auto right_side = [&](std::size_t i) -> Twist {
    return 3 * weight(i) * weight(i) * steps.motion[i];
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
      if (i > 0) {
        below = weight(i - 1);
        diagonal[i] += 2 * below;
        slopes[i] += right_side(i - 1);
      }
      if (i < last) {
        above[i] = weight(i);
        diagonal[i] += 2 * above[i];
        slopes[i] += right_side(i);
      }
    }
    if (i == 0) continue;
    const double factor = below / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    slopes[i] -= factor * slopes[i - 1];
  }
  slopes[last] /= diagonal[last];
  for (std::size_t i = last; i-- > 0;)
    slopes[i] = (slopes[i] - above[i] * slopes[i + 1]) / diagonal[i];
  return slopes;
}

/// The segment from `from` by `motion`, with given velocities at both ends; all with respect to s.
SplineSegment segment_of(const Pose& from, const Twist& motion, const Twist& at_from,
                         const Twist& at_to) {
  const Twist second_from = 6 * motion - 4 * at_from - 2 * at_to;  // of the cubic
  const Twist second_to = -6 * motion + 2 * at_from + 4 * at_to;
  SplineSegment segment;
  segment.terms.col(1) = at_from;
  segment.terms.col(2) = second_from / 2;
  segment.terms.col(3) = (second_to - second_from) / 6;
  const Vector3 half = motion.tail<3>() / 2;
  const auto rates = [](const Vector3& r, const Twist& first, const Twist& second) {
    return rotation_vector_rates(r, {first.tail<3>(), second.tail<3>()});
  };
  const RotationRates first = rates(-half, at_from, second_from),
                      last = rates(half, at_to, second_to);
  const auto quintic = quintic_between<Vector3>(2 * half, first.velocity, first.acceleration,
                                                last.velocity, last.acceleration);
  segment.terms.col(0).tail<3>() = -half;
  for (int k = 0; k < 5; ++k) segment.terms.col(k + 1).tail<3>() = quintic.c[std::size_t(k)];
  segment.centre = from;
  segment.centre.linear() = so3_exp(half) * from.linear();
  return segment;
}

/// The inner knots at which the spline turns back.
std::vector<std::size_t> reversals(const std::vector<Twist>& slopes) {
  std::vector<std::size_t> knots;
  for (std::size_t i = 1; i + 1 < slopes.size(); ++i) {
    const double speed =
        std::hypot(slopes[i].head<3>().norm(), metres_per_radian * slopes[i].tail<3>().norm());
    if (speed < min_spline_speed) knots.push_back(i);
  }
  return knots;
}

}  // namespace

ToolPath spline_through(std::span<const Pose> poses, const SplineEnds& ends) {
  const Steps steps = steps_between(poses);
  const std::vector<Twist> slopes = slopes_of(steps, ends);
  ToolPath path;
  std::vector<std::size_t> knots = reversals(slopes);
  if (!knots.empty()) {
    knots.insert(knots.begin(), 0);
    knots.push_back(poses.size() - 1);
    for (std::size_t i = 1; i < knots.size(); ++i) {
      const SplineEnds part{i == 1 ? ends.first : std::nullopt,
                            i + 1 == knots.size() ? ends.last : std::nullopt};
      const ToolPath spline =
          spline_through(poses.subspan(knots[i - 1], knots[i] - knots[i - 1] + 1), part);
      path.segments.insert(path.segments.end(), spline.segments.begin(), spline.segments.end());
      path.spans.insert(path.spans.end(), spline.spans.begin(), spline.spans.end());
    }
    return path;
  }
  for (std::size_t i = 0; i < steps.motion.size(); ++i) {
    const double span = steps.span[i];
    path.segments.emplace_back(
        segment_of(poses[i], steps.motion[i], span * slopes[i], span * slopes[i + 1]));
    path.spans.push_back(span);
  }
  return path;
}

}  // namespace beeline::internal

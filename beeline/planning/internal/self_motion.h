#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/gauss_newton.h>
#include <beeline/kinematics/task.h>
#include <beeline/math/revolution.h>

namespace beeline::internal {

/// A configuration of an arm with one redundant joint: at most six rows and one, without
/// allocation.
using RedundantConfiguration = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 7, 1>;

/// A connected part, within the joint limits, of the self-motion manifold of one pose (Burdick
/// 1989): the curve of configurations with the tool at the pose. Its ends are at limits or at
/// singularities.
struct SelfMotionCurve {
  std::vector<RedundantConfiguration> nodes;  ///< in their order along the curve
  bool closed = false;                        ///< the last node is followed by the first
};

/// The self-motions of an arm that has one joint more than its task has rows: solutions q of
///     f(q) = pose,   lower <= q <= upper,
/// followed along the null space of the task's Jacobian. Not thread-safe.
class SelfMotion {
 public:
  /// Coordinates in `cyclic` have no bounds and are angles: curves may close after a revolution.
  /// `step` is the distance of neighbouring nodes, radians or metres.
  SelfMotion(const Arm& arm, const Task& task, const Bounds& bounds,
             const std::vector<bool>& cyclic, double step);

  double step() const { return step_; }
  const Bounds& bounds() const { return bounds_; }

  /// Solves for the configuration with the tool at the pose that is nearest to q, limits ignored;
  /// returns whether there is one. 1e-7 m and rad.
  bool solve(const Pose& pose, RedundantConfiguration& q);

  /// The smallest margin of a joint to its limits, relative to half its range; see limit_margin().
  double margin(const RedundantConfiguration& q) const;

  /// b - a, cyclic coordinates by the shorter way.
  RedundantConfiguration difference(const RedundantConfiguration& b,
                                    const RedundantConfiguration& a) const;

  /// Computes the same; returns whether no coordinate differs by more than `reach`. If one does,
  /// the difference is not complete.
  bool difference_within(double reach, const RedundantConfiguration& b,
                         const RedundantConfiguration& a, RedundantConfiguration& difference) const;

  /// Traces the curve through q, a solution within the limits, to its ends.
  SelfMotionCurve curve_through(const Pose& pose, const RedundantConfiguration& q);

  /// The same without limits.
  SelfMotionCurve unlimited_curve_through(const Pose& pose, const RedundantConfiguration& q);

  /// Maximises margin() along the self-motion from the solution q, by steps of at most `reach`,
  /// until it is zero or more; nothing if it remains negative.
  std::optional<RedundantConfiguration> move_inside(const Pose& pose, RedundantConfiguration q,
                                                    double reach);

 private:
  double coordinate_difference(Eigen::Index k, double b, double a) const;
  bool tangent(const RedundantConfiguration& q, RedundantConfiguration& direction) const;
  bool follow(const Pose& pose, bool limited, RedundantConfiguration direction,
              std::vector<RedundantConfiguration>& nodes);
  bool to_limit(const Pose& pose, const RedundantConfiguration& inside,
                const RedundantConfiguration& outside, RedundantConfiguration& at_limit);
  SelfMotionCurve traced(const Pose& pose, const RedundantConfiguration& q, bool limited);

  Arm arm_;
  Task task_;
  Bounds bounds_;
  RedundantConfiguration half_period_;  ///< pi, infinite for coordinates that are not cyclic
  double step_;
  NumericalProblem problem_;  ///< without bounds
  GaussNewtonState solver_;
};

inline double SelfMotion::coordinate_difference(Eigen::Index k, double b, double a) const {
  constexpr double one_period = 9;  // below 3 pi; the difference from a revolution is then exact
  const double d = b - a, size = std::abs(d);
  if (!(size > half_period_[k])) return d;
  return size < one_period ? d - std::copysign(revolution, d) : std::remainder(d, revolution);
}

inline bool SelfMotion::difference_within(double reach, const RedundantConfiguration& b,
                                          const RedundantConfiguration& a,
                                          RedundantConfiguration& difference) const {
  difference.resize(b.size());
  for (Eigen::Index k = 0; k < b.size(); ++k) {
    difference[k] = coordinate_difference(k, b[k], a[k]);
    if (std::abs(difference[k]) > reach) return false;
  }
  return true;
}

/// The index of the node of the curve that is nearest to q; nothing if q is farther than
/// `tolerance` from all chords between neighbouring nodes.
std::optional<std::size_t> node_near(const SelfMotion& motion, const SelfMotionCurve& curve,
                                     const RedundantConfiguration& q, double tolerance);

/// Whether q is within `tolerance` of a node or a chord of the curve.
bool passes(const SelfMotion& motion, const SelfMotionCurve& curve, const RedundantConfiguration& q,
            double tolerance);

/// The curves through configurations at the pose, each once. If the budget ends the computation,
/// only some of the first configurations have places.
struct SelfMotionCurves {
  std::vector<SelfMotionCurve> curves;
  struct Place {
    std::size_t curve = 0, node = 0;
  };
  std::vector<Place> places;  ///< the node nearest to each configuration
};
SelfMotionCurves curves_through(SelfMotion& motion, const Pose& pose,
                                const std::vector<RedundantConfiguration>& solutions,
                                BudgetMeter& budget);

}  // namespace beeline::internal

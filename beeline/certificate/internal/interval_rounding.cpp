#include <cmath>
#include <limits>

#include <beeline/certificate/internal/interval_rounding.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

// The constants are counts of operations, to first order in e = 2 u, where u is the largest
// relative error of an operation. sin, cos, tan and atan2 are assumed to be wrong by less than one
// unit in the last place, 2 u (glibc and musl are). Norms of matrices are Frobenius norms, which
// are at least the error of a rotated unit vector and the error of a chord.
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A joint multiplies the pose by offset * exp(screw q) (link_poses()):
//   - I + sin q [w] + 2 sin^2(q / 2) [w]^2, screw_motion(): the terms are wrong by 3 u and 8 u, and
//     their norms are sqrt(2) |sin q| and sqrt(2) (1 - cos q), which makes 23.4 u at most; the sums
//     add u (2 sqrt(2) + sqrt(3)) < 4.6 u;
//   - two products of rotations, each wrong by 3 u |A| |B|, whose norm is at most 9 u.
// These are 46 u < 24 e. Positions are wrong by this rotation of the lengths behind the joint, and
// by sums: (2 n + 1) u of all lengths L, 11 u for the elements of R t, 22 u for screw_motion(). So
// a position is wrong by (48 n + 34) u L < 24 e (n + 2) L.
constexpr double of_rotation = 24 * epsilon;

// A coordinate sum_k c_k x^k. With v = sum |c_k|, v' = sum k |c_k|, v'' = sum k (k - 1) |c_k| its
// value is wrong by
//   - the coefficients from the samples (cubic_between(), quintic_between()): (7 v' + 24 v'') u,
//   - a part for a segment of the path (Polynomial::part()): (v + 4 v') u,
//   - ten halvings, each (v + 2 v') u, of which v' halves too: (10 v + 4 v') u,
//   - Horner's scheme: (v + 2 v') u, and the ratio and the shift of a coupling: 2 v u and the shift
//     times u.
// These are (14 v + 17 v' + 24 v'') u < 8 e (v + 2 v' + 2 v'').
constexpr double of_polynomial = 8 * epsilon;

// A pose of a segment, relative to size_of(). A rotation exp(s log(R_to R_from^T)) R_from is wrong
// by 66 u in the logarithm (the product 9 u, its quaternion at most 16 u, of which the vector is
// stretched by up to pi, and atan2 with its quotient 16 u), 28 u in the exponential and 7 u in the
// product: 101 u. A position of a line is wrong by 4 u of its ends, of an arc by (5 angle + 20) u
// of its centre and radius, of a spline by 11 u of its terms. On a screw the logarithm of the pose
// is multiplied by the inverse of the left Jacobian, its exponential by the Jacobian: 78 u.
constexpr double of_segment = 32 * epsilon;

// The first and second derivatives are wrong by a few times as much, times the rates of the angles.
// They enter the Bernstein coefficients of H (tool_error.cpp) divided by 5 / 2 and by 20.

/// Sums of |c_k|, k |c_k| and k (k - 1) |c_k|, which bound a polynomial and its first two
/// derivatives on [0, 1].
struct Magnitudes {
  double value = 0, first = 0, second = 0;

  explicit Magnitudes(const Polynomial& p) {
    double k = 0;
    for (const double c : p.c) {
      value += std::abs(c);
      first += k * std::abs(c);
      second += k * (k - 1) * std::abs(c);
      ++k;
    }
  }
  double sum() const { return value + first + second; }
  /// Bounds the error of the polynomial's value.
  double rounding() const { return of_polynomial * (value + 2 * first + 2 * second); }
};

/// The numbers of a segment of which of_segment is a fraction: 32 e angle and 32 e position bound
/// the errors that are counted above.
struct Size {
  double position = 0, angle = 0;
};

double distance(const Pose& pose) { return pose.translation().norm(); }

Size size_of(const Line& line) { return {distance(line.from) + distance(line.to), 4}; }
Size size_of(const ScrewLine& screw) {
  return {2 * (distance(screw.from) + distance(screw.to)), 4};
}
Size size_of(const Arc& arc) {
  const double radius = (arc.from.translation() - arc.centre).norm();
  return {(arc.centre.norm() + radius) * (1 + arc.rotation.norm()), 8};
}
Size size_of(const SplineSegment& spline) {
  const Matrix6 terms = spline.terms.cwiseAbs();
  return {distance(spline.centre) + terms.topRows<3>().sum(), 1 + terms.bottomRows<3>().sum()};
}

}  // namespace

IntervalRounding::IntervalRounding(const Arm& arm, const Segment& segment, const Task& task)
    : arm_(arm), tool_axes_(task.frame == Frame::tool) {
  // Lengths may cancel in the description and be absent from the chain, or the reverse.
  const Chain& chain = chain_of(arm);
  arm_length_ =
      distance(arm.base()) + distance(arm.tool()) + distance(chain.base) + distance(chain.tool);
  for (const Joint& joint : arm.joints()) {
    arm_length_ += distance(joint.offset);
    if (kind(joint) != JointKind::prismatic) arm_length_ += 2 * joint.screw.head<3>().norm();
  }
  for (const Chain::Link& link : chain.links) arm_length_ += link.translation.norm();
  const Size size = std::visit([](const auto& kind) { return size_of(kind); }, segment);
  segment_size_ = size.position;
  segment_angle_ = size.angle;
}

Deviation IntervalRounding::error_bounds(const Interval& interval,
                                         const SegmentTaylorBound& bound) const {
  const Chain& chain = chain_of(arm_);
  double relative = of_rotation * (static_cast<double>(chain.links.size()) + 2);
  double length = arm_length_, turn = 0, second = 0;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Chain::Link& link = chain.links[i];
    const double shift = std::abs(arm_.couplings()[i].shift);
    const Magnitudes q(interval.coordinates[static_cast<std::size_t>(link.coordinate)]);
    if (link.theta_per_q != 0) {
      relative += std::abs(link.theta_per_q) * q.rounding() +
                  of_polynomial * (shift + std::abs(link.theta_offset));
    }
    if (link.d_per_q != 0) length += std::abs(link.d_per_q) * q.sum() + shift;
    turn += std::abs(link.theta_per_q) * q.first;
    second += std::abs(link.theta_per_q) * q.second;
  }
  const double tool = relative * (1 + turn + turn * turn + second);
  const Magnitudes s(interval.s);
  const TaylorBound rates = taylor_bound(interval.s);
  const double segment = of_segment * (1 + rates.c[1] + rates.c[1] * rates.c[1] + 2 * rates.c[2]);
  const double s_error = s.rounding() * (1 + rates.c[1] + 2 * rates.c[2]);
  return {tool * (length + (tool_axes_ ? segment_size_ : 0)) + segment * segment_size_ +
              s_error * bound.position.c[1],
          tool + segment * segment_angle_ + s_error * bound.rotation.c[1]};
}

}  // namespace beeline::internal

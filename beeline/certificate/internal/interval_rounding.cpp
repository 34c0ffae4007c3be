#include <cmath>
#include <limits>

#include <beeline/certificate/internal/interval_rounding.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double of_rotation = 8 * epsilon;    // of a product with a rotation, relative
constexpr double of_polynomial = 8 * epsilon;  // of its value, relative to the sum of its terms
constexpr double of_segment = 32 * epsilon;    // of interpolation by exp and log, relative

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
};

struct Size {
  double position = 0, angle = 0;
};

double distance(const Pose& pose) { return pose.translation().norm(); }

Size size_of(const Line& line) { return {distance(line.from) + distance(line.to), 4}; }
Size size_of(const ScrewLine& screw) { return {distance(screw.from) + distance(screw.to), 4}; }
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

Deviation IntervalRounding::on(const Interval& interval, const SegmentTaylorBound& bound) const {
  const Chain& chain = chain_of(arm_);
  double relative = of_rotation * (static_cast<double>(chain.links.size()) + 2);
  double length = arm_length_, turn = 0, second = 0;
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Chain::Link& link = chain.links[i];
    const double shift = std::abs(arm_.couplings()[i].shift);
    const Magnitudes q(interval.coordinates[static_cast<std::size_t>(link.coordinate)]);
    if (link.theta_per_q != 0) {
      relative += of_polynomial * (std::abs(link.theta_per_q) * q.value + shift) +
                  of_rotation * std::abs(link.theta_offset);
    }
    if (link.d_per_q != 0) length += std::abs(link.d_per_q) * q.sum() + shift;
    turn += std::abs(link.theta_per_q) * q.first;
    second += std::abs(link.theta_per_q) * q.second;
  }
  const double tool = relative * (1 + turn + turn * turn + second);
  const Magnitudes s(interval.s);
  const TaylorBound rates = taylor_bound(interval.s);
  const double segment = of_segment * (1 + rates.c[1] + rates.c[1] * rates.c[1] + 2 * rates.c[2]);
  const double s_error = of_polynomial * s.value * (1 + rates.c[1] + 2 * rates.c[2]);
  return {tool * (length + (tool_axes_ ? segment_size_ : 0)) + segment * segment_size_ +
              s_error * bound.position.c[1],
          tool + segment * segment_angle_ + s_error * bound.rotation.c[1]};
}

}  // namespace beeline::internal

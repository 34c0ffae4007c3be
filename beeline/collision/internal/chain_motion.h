#pragma once

#include <memory>
#include <span>
#include <vector>

#include <beeline/collision/internal/convex_body.h>
#include <beeline/collision/internal/joint_tube.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// The largest distances of a body's points from the axes of the joints in front of it, over all
/// configurations of a range: `of[l]` for joint l + 1. It depends on the configuration through
/// joints that slide only.
struct JointReach {
  std::vector<double> of;
};

/// The frames of an arm at the middle of a joint tube, with the velocities of the links along it.
/// Positions are relative to the origin of link 0, in the world's axes: an arm far from the world's
/// origin loses no digits.
class ChainMotion {
 public:
  explicit ChainMotion(const Arm& arm);

  /// The frame of joint i, from 1 to n, which is fixed to link i. Frame 0 is fixed to the base.
  struct Frame {
    Rotation rotation = Rotation::Identity();
    Vector3 origin = Vector3::Zero();
    /// Motion of the link along the half motion, from the middle to the end: the displacement of
    /// its point at the origin of link 0 and the rotation vector, to first order.
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  };

  /// Moves the frames to a tube.
  void set(const JointTube& tube);

  const Frame& frame(std::size_t i) const { return frames_[i]; }
  std::size_t size() const { return frames_.size(); }  ///< n + 1

  /// Pose in frame i of the frame of link i, Joint::offset * exp(screw q). Frame 0 holds the link's
  /// pose in the world relative to its origin, without translation.
  const Pose& link_frame(std::size_t i) const { return link_frames_[i]; }
  const Vector3& origin() const { return world_origin_; }  ///< of link 0, in the world

  /// Whether the reach of bodies on frame i depends on the configuration.
  bool slides(std::size_t i) const;

  /// Computes the reach of a body that frame i carries. Joints that slide are between the values
  /// `lower` and `upper` of their coordinates.
  JointReach reach(const ConvexBody& body, std::size_t i, const Eigen::VectorXd& lower,
                   const Eigen::VectorXd& upper) const;
  /// Raises `largest`, of size i + 1, to the reach of the body.
  void include_reach(const ConvexBody& body, std::size_t i, const Eigen::VectorXd& lower,
                     const Eigen::VectorXd& upper, JointReach& largest) const;

  /// Bounds the distance by which the points of a body on frame i differ from their first-order
  /// motion relative to frame j < i, over the tube, m. With n the motion of a point and q_m the
  /// middle, Taylor's theorem along the half motion h gives sum_{k,l} |h_k h_l| |d2 n / dq_k dq_l|
  /// / 2, whose second derivative is at most the distance of the point from the later joint's axis,
  /// and the mean value theorem sum_l slack_l |dn / dq_l|.
  double remainder(const JointReach& reach, std::size_t i, std::size_t j) const;

  /// Bounds the distance by which the points of a body on frame i move relative to frame j < i from
  /// the middle of the tube, m.
  double displacement(const JointReach& reach, std::size_t i, std::size_t j) const;

  /// displacement() and remainder() of a body on frame i relative to frame j < i.
  struct TubeBounds {
    double displacement = 0, remainder = 0;
  };
  TubeBounds bounds(const JointReach& reach, std::size_t i, std::size_t j) const;

  /// Bounds the rounding error of the position of a point on frame i that is at most `distance`
  /// from its origin, m, and of the first-order motion.
  double rounding(std::size_t i, double distance) const;

 private:
  /// rounding() of frame i: at_origin + relative * distance.
  struct FrameRounding {
    double at_origin = 0, relative = 0;
  };
  void set_rounding();

  struct JointStep {
    double angle = 0, slide = 0;  ///< |rotation| and |translation| along the half motion
    double angle_slack = 0, slide_slack = 0;  ///< of the slack
    double angle_rounding = 0, slide_rounding = 0;
  };

  std::shared_ptr<const Arm> arm_;  ///< with link 0 at the world's origin; shared by copies
  Vector3 world_origin_;
  std::vector<Frame> frames_;
  std::vector<JointStep> steps_;
  std::vector<Pose> link_frames_;
  std::vector<FrameRounding> rounding_;
  std::vector<double> chain_length_;  ///< of the translations up to frame i, at the middle
};

}  // namespace beeline::internal

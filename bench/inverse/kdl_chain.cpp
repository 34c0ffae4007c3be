#include "kdl_chain.h"

namespace beeline::bench {

KDL::Frame frame_of(const Pose& pose) {
  const Rotation& r = pose.linear();
  const Vector3 p = pose.translation();
  return {KDL::Rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                        r(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

Pose pose_of(const KDL::Frame& frame) {
  Pose pose = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.linear()(i, k) = frame.M(i, k);
    pose.translation()[i] = frame.p(i);
  }
  return pose;
}

KDL::Chain kdl_chain(const Screws& screws) {
  KDL::Chain kdl;
  Pose from = axis_frame(screws, 0);
  kdl.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame_of(from)));
  for (int i = 0; i < screws.joints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Pose to = i + 1 < screws.joints ? axis_frame(screws, k + 1) : screws.home;
    kdl.addSegment(
        KDL::Segment(KDL::Joint(screws.slides[k] ? KDL::Joint::TransZ : KDL::Joint::RotZ),
                     frame_of(from.inverse() * to)));
    from = to;
  }
  return kdl;
}

}  // namespace beeline::bench

#include "kdl_peer.h"

#include <beeline/error.h>

#include "poses.h"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>

namespace beeline::bench {
namespace {

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

/// A frame with z along each joint's axis, so that KDL's joints are its quick ones about and along
/// z, as they are for an arm that comes as a DH table.
Pose axis_frame(const Screws& screws, std::size_t i) {
  Pose frame = Pose::Identity();
  frame.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), screws.axis[i]).toRotationMatrix();
  frame.translation() = screws.point[i];
  return frame;
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

Eigen::Matrix<double, 6, 1> even_weights() { return Eigen::Matrix<double, 6, 1>::Ones(); }

}  // namespace

struct KdlPeer::Solver {
  KDL::Chain chain;
  KDL::ChainIkSolverPos_LMA lma;  // keeps a reference to the chain
  KDL::JntArray seed, answer;

  // KDL's default weights would let the orientation be a hundred times less exact.
  explicit Solver(const Screws& arm)
      : chain(kdl_chain(arm)),
        lma(chain, even_weights(), 1e-6),
        seed(static_cast<unsigned>(arm.joints)),
        answer(static_cast<unsigned>(arm.joints)) {}
};

bool KdlPeer::installed() { return true; }

KdlPeer::KdlPeer(const Screws& screws) : solver_(std::make_unique<Solver>(screws)) {
  KDL::ChainFkSolverPos_recursive fk(solver_->chain);
  Engine engine(1);
  for (int n = 0; n < 100; ++n) {
    const Configuration q = random_configuration(screws, engine);
    solver_->seed.data = q;
    KDL::Frame tool;
    fk.JntToCart(solver_->seed, tool);
    if (!(miss(forward(screws, q), pose_of(tool)) < 1e-12)) {
      throw Error("KDL's forward kinematics differs from the benchmark's own");
    }
  }
}

KdlPeer::~KdlPeer() = default;

bool KdlPeer::solve(const Pose& world_T_tool, const Configuration& seed, Configuration& q) {
  solver_->seed.data = seed;
  const bool arrived =
      solver_->lma.CartToJnt(solver_->seed, frame_of(world_T_tool), solver_->answer) == 0;
  q = solver_->answer.data;
  return arrived;
}

}  // namespace beeline::bench

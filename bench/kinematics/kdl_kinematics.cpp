#include "../inverse/kdl_chain.h"
#include "peers.h"

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

namespace beeline::bench {
namespace {

class KdlKinematics : public KinematicsPeer {
 public:
  explicit KdlKinematics(const Screws& screws)
      : chain_(kdl_chain(screws)),
        forward_(chain_),
        jacobian_(chain_),
        q_(static_cast<unsigned>(screws.joints)),
        columns_(static_cast<unsigned>(screws.joints)) {}

  const char* name() const override { return "KDL"; }

  Pose forward(const Configuration& q) override {
    q_.data = q;
    KDL::Frame tool;
    forward_.JntToCart(q_, tool);
    return pose_of(tool);
  }

  double jacobian(const Configuration& q) override {
    q_.data = q;
    jacobian_.JntToJac(q_, columns_);
    return columns_.data(0, 0);
  }

 private:
  KDL::Chain chain_;
  KDL::ChainFkSolverPos_recursive forward_;
  KDL::ChainJntToJacSolver jacobian_;
  KDL::JntArray q_;
  KDL::Jacobian columns_;
};

}  // namespace

std::unique_ptr<KinematicsPeer> kdl_kinematics(const Screws& screws) {
  return std::make_unique<KdlKinematics>(screws);
}

}  // namespace beeline::bench

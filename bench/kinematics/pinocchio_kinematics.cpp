#include <beeline/kinematics/jacobian.h>

#include "peers.h"

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/multibody.hpp>

namespace beeline::bench {
namespace {

pinocchio::SE3 se3(const Pose& pose) { return {pose.linear(), pose.translation()}; }

/// Joints about and along z, Pinocchio's fastest.
pinocchio::Model model_of(const Screws& screws) {
  pinocchio::Model model;
  pinocchio::JointIndex joint = 0;
  Pose from = Pose::Identity();
  for (int i = 0; i < screws.joints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Pose at = axis_frame(screws, k);
    const std::string name = "joint" + std::to_string(i);
    const pinocchio::SE3 placement = se3(from.inverse() * at);
    joint = screws.slides[k] ? model.addJoint(joint, pinocchio::JointModelPZ(), placement, name)
                             : model.addJoint(joint, pinocchio::JointModelRZ(), placement, name);
    from = at;
  }
  model.addFrame(
      pinocchio::Frame("tool", joint, 0, se3(from.inverse() * screws.home), pinocchio::OP_FRAME));
  return model;
}

class PinocchioKinematics : public KinematicsPeer {
 public:
  explicit PinocchioKinematics(const Screws& screws)
      : model_(model_of(screws)),
        data_(model_),
        tool_(model_.getFrameId("tool")),
        columns_(Jacobian::Zero(6, screws.joints)) {}

  const char* name() const override { return "Pinocchio"; }

  Pose forward(const Configuration& q) override {
    pinocchio::forwardKinematics(model_, data_, q);
    const pinocchio::SE3& tool = pinocchio::updateFramePlacement(model_, data_, tool_);
    Pose pose = Pose::Identity();
    pose.linear() = tool.rotation();
    pose.translation() = tool.translation();
    return pose;
  }

  double jacobian(const Configuration& q) override {
    pinocchio::computeJointJacobians(model_, data_, q);
    pinocchio::updateFramePlacement(model_, data_, tool_);
    pinocchio::getFrameJacobian(model_, data_, tool_, pinocchio::LOCAL_WORLD_ALIGNED, columns_);
    return columns_(0, 0);
  }

 private:
  pinocchio::Model model_;
  pinocchio::Data data_;
  pinocchio::FrameIndex tool_;
  Jacobian columns_;
};

}  // namespace

std::unique_ptr<KinematicsPeer> pinocchio_kinematics(const Screws& screws) {
  return std::make_unique<PinocchioKinematics>(screws);
}

}  // namespace beeline::bench

#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/closed_form.h>

namespace beeline {
namespace {

Pose turn_about_z(double angle) { return Pose(Eigen::AngleAxisd(angle, Vector3::UnitZ())); }

/// Every joint has a coordinate of its own, and turns or slides but does not do both.
bool plain(const Arm& arm, const Chain& chain) {
  if (static_cast<int>(chain.links.size()) != arm.dof()) return false;
  for (const Chain::Link& link : chain.links) {
    if ((link.theta_per_q != 0) == (link.d_per_q != 0)) return false;
  }
  return true;
}

/// The chain with joints added at the tool, turning about these axes of the tool in this order.
Chain with_joints_at_tool(const Chain& chain, const std::string& axes) {
  Chain longer = chain;
  Pose last_T_tool = chain.tool;  // what is left to go at the end
  for (const char axis : axes) {
    // A frame at the tool whose z is the axis, and how the tool lies in it.
    Pose tool_T_joint = Pose::Identity();
    if (axis == 'x') tool_T_joint.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    if (axis == 'y') tool_T_joint.linear() << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    const Pose before = last_T_tool * tool_T_joint;
    // Any rotation is a turn about z, then x, then z: the first is the joint's before.
    const Rotation r = before.linear();
    const double alpha = std::atan2(std::hypot(r(0, 2), r(1, 2)), r(2, 2));
    const double first = std::atan2(r(0, 2), -r(1, 2));
    const Pose left = turn_about_z(first) * Eigen::AngleAxisd(alpha, Vector3::UnitX());
    Chain::Link& previous = longer.links.back();
    previous.theta_offset += first;
    Chain::Link link;
    link.cos_alpha = std::cos(alpha);
    link.sin_alpha = std::sin(alpha);
    link.translation = turn_about_z(-first) * before.translation();
    const Rotation rest = left.linear().transpose() * r;
    link.theta_offset = std::atan2(rest(1, 0), rest(0, 0));
    link.theta_per_q = 1;
    link.coordinate = static_cast<int>(longer.links.size());
    longer.links.push_back(link);
    last_T_tool = tool_T_joint.inverse(Eigen::Isometry);
  }
  longer.tool = last_T_tool;
  return longer;
}

/// The last three joints of the chain, all of them added, turn about the tool's origin: where one
/// comes to lie in another's line their share is free, which is no matter.
struct Added {
  std::string axes;
  bool any_value = false;
};

/// Which joints may be added so that six solve the task: the first choice that makes a loop counts.
std::vector<Added> additions(int dof, const Task& task) {
  const bool spatial = task.size() == 6;
  const Task rolling{{true, true, true, true, true, false}, Frame::tool};
  const Task position{{true, true, true, false, false, false}, task.frame};
  if (dof == 6 && spatial) return {{"", false}};
  if (dof == 5 && spatial) return {{"z", false}, {"y", false}, {"x", false}};
  if (dof == 5 && task == rolling) return {{"z", true}};
  if (dof == 4 && spatial) {
    return {{"xy", false}, {"yx", false}, {"zx", false},
            {"zy", false}, {"xz", false}, {"yz", false}};
  }
  if (dof == 3 && task == position) return {{"zyx", true}, {"zxy", true}};
  return {};
}

}  // namespace

std::optional<ClosedForm> ClosedForm::of(const Arm& arm, const Task& task) {
  const Chain& chain = arm.chain();
  if (!plain(arm, chain)) return std::nullopt;
  ClosedForm form;
  form.dof_ = arm.dof();
  if (arm.dof() == 7 && task.size() == 6) {
    Chain six = chain;  // without the last joint
    form.locked_link_ = chain.links.back();
    six.links.pop_back();
    six.tool = Pose::Identity();
    if (const auto loop = six_loop(six)) {
      form.loop_ = *loop;
      form.locked_ = 6;
      form.coordinates_ = {0, 1, 2, 3, 4, 5};
      form.locked_before_ = constant_transform(form.locked_link_);
      form.locked_after_ = chain.tool;
      return form;
    }
    six = chain;  // without the first
    form.locked_link_ = chain.links.front();
    six.links.erase(six.links.begin());
    six.base = constant_transform(six.links.front());
    six.links.front().translation.setZero();
    six.links.front().cos_alpha = 1;
    six.links.front().sin_alpha = 0;
    if (const auto loop = six_loop(six)) {
      form.loop_ = *loop;
      form.locked_ = 0;
      form.coordinates_ = {1, 2, 3, 4, 5, 6};
      form.locked_before_ = chain.base;
      return form;
    }
    return std::nullopt;
  }
  for (const Added& added : additions(arm.dof(), task)) {
    const auto loop = six_loop(with_joints_at_tool(chain, added.axes));
    if (!loop) continue;
    form.loop_ = *loop;
    for (std::size_t k = 0; k < 6; ++k) {
      const bool own = static_cast<int>(k) < arm.dof();
      form.coordinates_[k] = own ? static_cast<int>(k) : -1;
      form.any_value_[k] = !own && added.any_value;
    }
    return form;
  }
  return std::nullopt;
}

SixQuestion ClosedForm::question(const ConfigurationRef& seed, const Configuration& lower,
                                 const Configuration& upper, double tolerance) const {
  SixQuestion question{};
  question.closed = std::min(1e-12 * std::max(1.0, loop_.size), tolerance);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(loop_.order[i]);  // the coordinate of loop joint i
    const int own = coordinates_[k];
    const bool slides = i < 3 && loop_.slides[i];
    question.seed[k] = own < 0 ? 0 : seed[own];
    question.wraps[k] = !slides;
    question.lower[k] = own < 0 ? (any_value_[k] ? -4 : 0) : lower[own];
    question.upper[k] = own < 0 ? (any_value_[k] ? 4 : 0) : upper[own];
  }
  return question;
}

void ClosedForm::branches(const Pose& world_T_tool, double locked_value, SixQuestion& question,
                          SixBranches& found) const {
  Pose goal = world_T_tool;
  if (locked_ == 6) {
    goal = goal * (locked_before_ * joint_motion(locked_link_, locked_value) * locked_after_)
                      .inverse(Eigen::Isometry);
  } else if (locked_ == 0) {
    goal =
        (locked_before_ * joint_motion(locked_link_, locked_value)).inverse(Eigen::Isometry) * goal;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) question.world_T_tool[4 * i + j] = goal(i, j);
  }
  six_branches(loop_, question, found);
}

void ClosedForm::configuration(const SixBranches& found, int lane, double locked_value,
                               Eigen::Ref<Configuration> q) const {
  for (std::size_t k = 0; k < 6; ++k) {
    if (coordinates_[k] >= 0) q[coordinates_[k]] = found.q[k][lane];
  }
  if (locked_ >= 0) q[locked_] = locked_value;
}

}  // namespace beeline

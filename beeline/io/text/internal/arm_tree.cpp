#include <algorithm>
#include <cmath>

#include <beeline/io/text/internal/arm_tree.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr const char* root_frame = "base";  // as ROS-Industrial and the readers call them
constexpr const char* flange_frame = "tool0";

/// Makes the tree of an arm.
class TreeOfArm {
 public:
  TreeOfArm(const Arm& arm, ArmFileFormat format)
      : arm_(arm), urdf_(format == ArmFileFormat::urdf) {
    for (const Joint& joint : arm.joints()) {
      if (!joint.link.empty()) taken_.push_back(joint.link);
    }
  }

  WrittenTree tree() {
    find_gaps();
    const bool mounted = !arm_.base().matrix().isIdentity(0);
    tree_.root = urdf_ ? new_name(mounted ? "world" : "base_link", taken_) : "world";
    last_ = tree_.root;
    const ControllerFrames& controller = arm_.controller();
    const bool elsewhere = !controller.base.matrix().isIdentity(0);  // than readers assume
    if ((elsewhere || !controller.base_assumed) && is_free(root_frame, "")) {
      tree_.links.push_back({.name = root_frame, .parent = tree_.root, .pose = controller.base});
    }
    if (mounted) add_fixed(new_name("base_link", taken_), last_, arm_.base());
    for (std::size_t i = 0; i < arm_.joints().size(); ++i) add_joint(i);
    add_tool();
    return std::move(tree_);
  }

 private:
  void add_gap(ArmGapKind kind, const Joint& joint = {}) {
    tree_.gaps.push_back({.kind = kind, .joint = joint.name, .link = joint.link});
  }

  void find_gaps() {
    constexpr std::size_t max_nested = 90;  // of 100 elements that readers allow
    if (!urdf_ && arm_.joints().size() > max_nested) add_gap(ArmGapKind::too_many_joints);
    for (const Joint& joint : arm_.joints()) {
      if (kind(joint) == JointKind::helical) add_gap(ArmGapKind::helical_joint, joint);
      if (!urdf_ && joint.limits.lower == joint.limits.upper) {
        add_gap(ArmGapKind::equal_limits, joint);
      }
      if (!urdf_ && joint.link == "world") add_gap(ArmGapKind::reserved_link, joint);
      if (joint.link.empty()) continue;
      if (std::count(taken_.begin(), taken_.end(), joint.link) > 1) {
        add_gap(ArmGapKind::repeated_link, joint);
      }
    }
  }

  /// Whether a frame of the controller can have its name. Otherwise adds a gap, unless `owner`, the
  /// link that has the name, is the frame.
  bool is_free(const std::string& frame, const std::string& owner) {
    if (owner == frame) return false;
    for (const Joint& joint : arm_.joints()) {
      if (joint.link != frame) continue;
      add_gap(ArmGapKind::controller_frame, joint);
      return false;
    }
    taken_.push_back(frame);
    return true;
  }

  void add_fixed(const std::string& link, const std::string& parent, const Pose& pose) {
    tree_.links.push_back({.name = link, .parent = parent, .pose = pose});
    last_ = link;
  }

  void add_joint(std::size_t i) {
    const Joint& joint = arm_.joints()[i];
    constexpr double rounding = 1e-15;  // m, of a point that is the origin
    WrittenLink link{
        .name = joint.link.empty() ? new_name("link" + std::to_string(i + 1), taken_) : joint.link,
        .parent = last_,
        .pose = from_last_ * joint.offset,
        .joint = &joint};
    const Vector3 v = joint.screw.head<3>(), w = joint.screw.tail<3>();
    const bool slides = kind(joint) == JointKind::prismatic;
    link.axis = slides ? v : w;
    if (!slides && w.cross(v).norm() > rounding) link.point = w.cross(v);
    from_last_ = Pose::Identity();
    if (urdf_) {
      link.pose = link.pose * Eigen::Translation3d(link.point);
      from_last_ = Eigen::Translation3d(-link.point);
      link.point.setZero();
    }
    last_ = link.name;
    tree_.links.push_back(std::move(link));
  }

  void add_tool() {
    const ControllerFrames& controller = arm_.controller();
    Pose tool = from_last_ * arm_.tool();
    const Pose flange = from_last_ * controller.flange;
    const bool same = arm_.tool().matrix() == controller.flange.matrix();  // as readers assume
    const bool is_last = flange.matrix().isIdentity(0);
    const bool taken = last_ == flange_frame && !is_last;  // readers would take that link for it
    if (taken || !same || !controller.flange_assumed) {
      if (is_free(flange_frame, is_last ? last_ : "")) {
        add_fixed(flange_frame, last_, flange);
        tool = same ? Pose::Identity() : controller.flange.inverse() * arm_.tool();
      }
    }
    if (!tool.matrix().isIdentity(0)) add_fixed(new_name("tool", taken_), last_, tool);
  }

  const Arm& arm_;
  bool urdf_;
  std::vector<std::string> taken_;  ///< names of links
  WrittenTree tree_ = {};
  std::string last_;                   ///< the link that the next one is connected to
  Pose from_last_ = Pose::Identity();  ///< of the arm's link in that link
};

}  // namespace

WrittenTree written_tree(const Arm& arm, ArmFileFormat format) {
  return TreeOfArm(arm, format).tree();
}

std::string coordinate_text(double value) {
  constexpr double rounding = 1e-15;
  return exact(std::abs(value) < rounding ? 0 : value);
}

std::string coordinates_text(const Vector3& values) {
  return coordinate_text(values.x()) + " " + coordinate_text(values.y()) + " " +
         coordinate_text(values.z());
}

std::string new_name(std::string wanted, std::vector<std::string>& taken) {
  while (std::find(taken.begin(), taken.end(), wanted) != taken.end()) wanted += '_';
  taken.push_back(wanted);
  return wanted;
}

}  // namespace beeline::internal

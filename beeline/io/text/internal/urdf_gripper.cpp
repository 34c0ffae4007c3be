#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <unordered_map>

#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/urdf_gripper.h>

namespace beeline::internal {
namespace {

bool contains_any(const std::string& text, std::initializer_list<const char*> words) {
  const std::string lower = lower_case(text);
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return lower.find(word) != std::string::npos; });
}

/// The joint that leads each joint: itself without a leader in the file. A chain of more leaders
/// than any gripper has ends at its tenth.
std::vector<std::size_t> leaders_of(const UrdfFile& file) {
  std::unordered_map<std::string_view, std::size_t> index;
  for (std::size_t j = 0; j < file.joints.size(); ++j) index.emplace(file.joints[j].name, j);
  std::vector<std::size_t> leaders;
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    std::size_t leader = j;
    for (int step = 0; step < 10 && file.joints[leader].mimic; ++step) {
      const auto found = index.find(file.joints[leader].mimic->leader);
      if (found == index.end()) break;
      leader = found->second;
    }
    leaders.push_back(leader);
  }
  return leaders;
}

/// The joints below a link.
struct MovingBelow {
  std::size_t joints = 0;
  std::size_t any = 0;     ///< one of them
  bool one_leader = true;  ///< all of them have the leader of `any`
};

bool are_equal_slides(const UrdfFile::Joint& joint, const UrdfFile::Joint& other) {
  constexpr double tolerance = 1e-6;  // m
  const double range = joint.limits.upper - joint.limits.lower;
  return joint.type == "prismatic" && other.type == "prismatic" && range > 0 &&
         range < Limits::none &&
         std::abs(range - (other.limits.upper - other.limits.lower)) <= tolerance;
}

}  // namespace

std::vector<bool> fingers_by_structure(const UrdfFile& file, const std::vector<std::size_t>& links,
                                       const std::vector<std::vector<std::size_t>>& child_joints,
                                       const std::vector<std::size_t>& child_link) {
  const std::vector<std::size_t> leaders = leaders_of(file);
  std::vector<MovingBelow> below(child_joints.size());
  std::vector<bool> inside(child_joints.size(), false);  // links of a gripper, the palm included
  for (auto link = links.rbegin(); link != links.rend(); ++link) {
    MovingBelow& own = below[*link];
    std::size_t branches = 0;
    bool slides = true;
    for (const std::size_t j : child_joints[*link]) {
      MovingBelow branch = below[child_link[j]];
      if (has_one_dof(file.joints[j])) {
        branch.one_leader =
            branch.one_leader && (branch.joints == 0 || leaders[branch.any] == leaders[j]);
        branch.any = j;
        ++branch.joints;
      }
      if (branch.joints == 0) continue;
      if (own.joints == 0) own.any = branch.any;
      slides = slides && branch.joints == 1 &&
               are_equal_slides(file.joints[own.any], file.joints[branch.any]);
      own.one_leader =
          own.one_leader && branch.one_leader && leaders[own.any] == leaders[branch.any];
      own.joints += branch.joints;
      ++branches;
    }
    inside[*link] = branches >= 2 && (own.one_leader || slides);
  }
  std::vector<bool> fingers(file.joints.size(), false);
  for (const std::size_t link : links) {
    if (!inside[link]) continue;
    for (const std::size_t j : child_joints[link]) {
      fingers[j] = has_one_dof(file.joints[j]);
      inside[child_link[j]] = true;
    }
  }
  return fingers;
}

bool moves_finger(const UrdfFile::Joint& joint) {
  const auto fingers = {"finger", "knuckle", "thumb", "jaw", "claw"};
  if (contains_any(joint.name, fingers) || contains_any(joint.child, fingers)) return true;
  return contains_any(joint.name, {"gripper"}) &&
         !contains_any(joint.name, {"wrist", "roll", "pitch", "yaw", "rot", "base", "mount"});
}

}  // namespace beeline::internal

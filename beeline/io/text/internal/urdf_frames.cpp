#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <beeline/io/text/internal/urdf_frames.h>
#include <beeline/model/internal/ranges.h>

namespace beeline::internal {
namespace {

/// Returns the pose in link `from` of link `to`; none where a moving joint is between them, or a
/// distance that no arm has. Joints with a fault are left out; others may close cycles.
std::optional<Pose> fixed_pose(const UrdfFile& file, const std::string& from,
                               const std::string& to) {
  std::unordered_multimap<std::string, std::pair<std::string, Pose>> neighbours;
  std::unordered_set<std::size_t> faulty;
  for (const UrdfFault& fault : file.faults) {
    if (fault.index) faulty.insert(*fault.index);
  }
  for (std::size_t i = 0; i < file.joints.size(); ++i) {
    const UrdfFile::Joint& joint = file.joints[i];
    if (joint.type != "fixed" || faulty.contains(i)) continue;
    neighbours.emplace(joint.parent, std::pair(joint.child, joint.origin));
    neighbours.emplace(joint.child, std::pair(joint.parent, joint.origin.inverse()));
  }
  struct Visit {
    std::string link;
    Pose from_T_link;
  };
  std::vector<Visit> visits{{from, Pose::Identity()}};
  std::unordered_set<std::string> visited{from};
  for (std::size_t next = 0; next < visits.size(); ++next) {
    const Visit visit = visits[next];
    if (visit.link == to) {
      const bool near = visit.from_T_link.translation().cwiseAbs().maxCoeff() <= max_length;
      return near ? std::optional(visit.from_T_link) : std::nullopt;
    }
    const auto [begin, end] = neighbours.equal_range(visit.link);
    for (auto neighbour = begin; neighbour != end; ++neighbour) {
      const auto& [link, pose] = neighbour->second;
      if (visited.insert(link).second) visits.push_back({link, visit.from_T_link * pose});
    }
  }
  return std::nullopt;
}

}  // namespace

ControllerFrames controller_frames(const UrdfFile& file, const std::string& base,
                                   const std::string& tip, const Pose& tool) {
  const std::optional<Pose> root = fixed_pose(file, base, "base");
  const std::optional<Pose> flange = fixed_pose(file, tip, "tool0");
  return {.base = root.value_or(Pose::Identity()),
          .base_assumed = !root,
          .flange = flange ? tool * *flange : tool,
          .flange_assumed = !flange};
}

}  // namespace beeline::internal

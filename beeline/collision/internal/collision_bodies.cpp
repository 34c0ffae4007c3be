#include <algorithm>

#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {
namespace {

using BodyGroup = CollisionBodies::BodyGroup;

BodyGroup group_of(const CollisionBodies::LinkBody& body, std::uint32_t index) {
  const CarriedBody& carried = body.carried;
  BodyGroup group{.capsule = capsule_around(carried.body),
                  .frame = carried.frame,
                  .link_shapes = body.link_shapes,
                  .begin = index,
                  .end = index + 1,
                  .is_body = is_capsule(carried.body),
                  .reach = body.reach};
  if (!group.is_body) group.excess = estimated_excess(group.capsule, carried.body);
  group.size = group.capsule.size();
  group.magnitude = std::max(magnitude(carried.body), magnitude(group.capsule));
  return group;
}

/// The group of all bodies from index `begin` to before `end`.
BodyGroup group_of(const std::vector<BodyGroup>& groups, std::uint32_t begin, std::uint32_t end) {
  BodyGroup whole = groups[begin];
  whole.end = end;
  whole.is_body = false;
  std::vector<BoundingCapsule> capsules;
  for (std::uint32_t i = begin; i < end; ++i) {
    capsules.push_back(groups[i].capsule);
    whole.magnitude = std::max(whole.magnitude, groups[i].magnitude);
    for (std::size_t l = 0; l < whole.reach.of.size(); ++l) {
      whole.reach.of[l] = std::max(whole.reach.of[l], groups[i].reach.of[l]);
    }
  }
  whole.capsule = capsule_around(capsules);
  whole.size = whole.capsule.size();
  whole.magnitude = std::max(whole.magnitude, magnitude(whole.capsule));
  return whole;
}

std::size_t obstacle_pairs(const CollisionBodies& bodies) {
  std::size_t count = 0;
  for (const auto& link : bodies.link_bodies) {
    if (!CollisionBodies::meets_obstacles(link)) continue;
    for (const auto& obstacle : bodies.obstacle_bodies) {
      if (!bodies.allowed(link, obstacle.obstacle)) ++count;
    }
  }
  return count;
}

}  // namespace

void CollisionBodies::set_groups() {
  const auto count = static_cast<std::uint32_t>(link_bodies.size());
  for (std::uint32_t i = 0; i < count; ++i) groups.push_back(group_of(link_bodies[i], i));
  std::vector<std::uint32_t> whole_of(links.size());
  for (std::uint32_t begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && groups[end].link_shapes == groups[begin].link_shapes) ++end;
    if (end > begin + 1) groups.push_back(group_of(groups, begin, end));
    const std::size_t whole = end > begin + 1 ? groups.size() - 1 : begin;
    whole_of[groups[begin].link_shapes] = static_cast<std::uint32_t>(whole);
    link_groups.push_back(static_cast<std::uint32_t>(whole));
  }
  const auto wholes = [&](const SelfPair& pair) {
    return std::array{whole_of[link_bodies[pair.first].link_shapes],
                      whole_of[link_bodies[pair.second].link_shapes]};
  };
  std::stable_sort(self_pairs.begin(), self_pairs.end(),
                   [&](const auto& a, const auto& b) { return wholes(a) < wholes(b); });
  for (std::uint32_t i = 0; i < self_pairs.size(); ++i) {
    const auto [first, second] = wholes(self_pairs[i]);
    const bool same = !group_pairs.empty() && group_pairs.back().first == first &&
                      group_pairs.back().second == second;
    if (!same) group_pairs.push_back({first, second, i, i});
    group_pairs.back().end = i + 1;
  }
  pair_count = self_pairs.size() + obstacle_pairs(*this);
}

}  // namespace beeline::internal

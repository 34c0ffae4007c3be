#include <algorithm>

#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {
namespace {

using Cover = CollisionBodies::Cover;

Cover cover_of(const CollisionBodies::LinkBody& body, std::uint32_t index) {
  const CarriedBody& carried = body.carried;
  Cover cover{.capsule = capsule_around(carried.body),
              .frame = carried.frame,
              .link_shapes = body.link_shapes,
              .begin = index,
              .end = index + 1,
              .is_body = is_capsule(carried.body),
              .reach = body.reach};
  cover.size = cover.capsule.size();
  cover.magnitude = std::max(magnitude(carried.body), magnitude(cover.capsule));
  return cover;
}

/// The cover of single ones, from index `begin` to before `end`.
Cover cover_of(const std::vector<Cover>& covers, std::uint32_t begin, std::uint32_t end) {
  Cover whole = covers[begin];
  whole.end = end;
  whole.is_body = false;
  std::vector<BoundingCapsule> capsules;
  for (std::uint32_t i = begin; i < end; ++i) {
    capsules.push_back(covers[i].capsule);
    whole.magnitude = std::max(whole.magnitude, covers[i].magnitude);
    for (std::size_t l = 0; l < whole.reach.of.size(); ++l) {
      whole.reach.of[l] = std::max(whole.reach.of[l], covers[i].reach.of[l]);
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

void CollisionBodies::set_covers() {
  const auto count = static_cast<std::uint32_t>(link_bodies.size());
  for (std::uint32_t i = 0; i < count; ++i) covers.push_back(cover_of(link_bodies[i], i));
  std::vector<std::uint32_t> whole_of(links.size());
  for (std::uint32_t begin = 0, end = 0; begin < count; begin = end) {
    while (end < count && covers[end].link_shapes == covers[begin].link_shapes) ++end;
    if (end > begin + 1) covers.push_back(cover_of(covers, begin, end));
    const std::size_t whole = end > begin + 1 ? covers.size() - 1 : begin;
    whole_of[covers[begin].link_shapes] = static_cast<std::uint32_t>(whole);
    whole_links.push_back(static_cast<std::uint32_t>(whole));
  }
  const auto wholes = [&](const SelfPair& pair) {
    return std::array{whole_of[link_bodies[pair.first].link_shapes],
                      whole_of[link_bodies[pair.second].link_shapes]};
  };
  std::stable_sort(self_pairs.begin(), self_pairs.end(),
                   [&](const auto& a, const auto& b) { return wholes(a) < wholes(b); });
  for (std::uint32_t i = 0; i < self_pairs.size(); ++i) {
    const auto [first, second] = wholes(self_pairs[i]);
    const bool same = !self_groups.empty() && self_groups.back().first == first &&
                      self_groups.back().second == second;
    if (!same) self_groups.push_back({first, second, i, i});
    self_groups.back().end = i + 1;
  }
  pair_count = self_pairs.size() + obstacle_pairs(*this);
}

}  // namespace beeline::internal

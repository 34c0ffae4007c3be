#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <beeline/certificate/internal/tube_proof.h>

namespace beeline::internal {
namespace {

constexpr double nothing_proved = -std::numeric_limits<double>::infinity();

/// Sets a vector to its direction. Returns false if it has none.
bool normalize(Vector3& towards) {
  const double square = towards.squaredNorm();
  if (!(square > least_square)) return false;
  towards /= std::sqrt(square);
  return true;
}

ChainMotion& copied_into(std::optional<ChainMotion>& copy, const ChainMotion& motion) {
  copy = motion;
  return *copy;
}

}  // namespace

TubeProof::TubeProof(const CollisionBodies& bodies, const TubeValues& whole, double beyond)
    : bodies_(bodies),
      beyond_(beyond),
      motion_(copied_into(scratch_->motion, bodies.motion)),
      placed_(scratch_->placed) {
  placed_.assign(bodies.groups.size(), Placed());
  set_reach(whole);
}

/// Sets the reach that depends on the motion: of groups behind joints that slide.
void TubeProof::set_reach(const TubeValues& whole) {
  const auto depends = [](const CollisionBodies::BodyGroup& group) {
    return group.reach.of.empty();
  };
  if (std::none_of(bodies_.groups.begin(), bodies_.groups.end(), depends)) return;
  // The tube of a part exceeds the tube of the whole by at most the width of that tube.
  scratch_->lower = whole.middle - 3 * (whole.half_motion.cwiseAbs() + whole.slack);
  scratch_->upper = whole.middle + 3 * (whole.half_motion.cwiseAbs() + whole.slack);
  scratch_->reach.resize(std::max(scratch_->reach.size(), bodies_.groups.size()));
  for (std::size_t i = 0; i < bodies_.groups.size(); ++i) {
    const CollisionBodies::BodyGroup& group = bodies_.groups[i];
    if (!depends(group)) continue;
    JointReach& largest = scratch_->reach[i];
    largest.of.assign(group.frame + 1, 0);
    for (std::uint32_t k = group.begin; k < group.end; ++k) {
      motion_.include_reach(bodies_.link_bodies[k].carried.body, group.frame, scratch_->lower,
                            scratch_->upper, largest);
    }
  }
}

void TubeProof::place(const JointTube& tube) {
  motion_.set(tube);
  ++tube_;
}

const JointReach& TubeProof::reach(std::uint32_t i) const {
  const JointReach& constant = bodies_.groups[i].reach;
  return constant.of.empty() ? scratch_->reach[i] : constant;
}

void TubeProof::place_group(std::uint32_t i) {
  Placed& placed = placed_[i];
  if (placed.tube == tube_) return;
  placed.tube = tube_;
  const CollisionBodies::BodyGroup& group = bodies_.groups[i];
  const ChainMotion::Frame& frame = motion_.frame(group.frame);
  placed.capsule = carried_by(frame, group.capsule, motion_.bounds(reach(i), group.frame, 0));
  placed.rounding = motion_.rounding(group.frame, group.magnitude);
}

void TubeProof::place_both(const OpenPair& pair) {
  place_group(pair.body);
  if (is_of_links(pair)) place_group(pair.other);
}

bool TubeProof::is_of_links(const OpenPair& pair) const {
  return pair.with == OpenPair::With::link || pair.with == OpenPair::With::group;
}

double TubeProof::clearance(const OpenPair& pair) const {
  switch (pair.with) {
    case OpenPair::With::link:
    case OpenPair::With::group:
      return bodies_.options.clearance;
    case OpenPair::With::obstacle:
      return bodies_.obstacle_bodies[pair.other].clearance;
    case OpenPair::With::node:
      return bodies_.tree.node(pair.other).clearance;
  }
  return bodies_.options.clearance;
}

bool TubeProof::comes_before(const OpenPair& a, const OpenPair& b) {
  return std::tie(a.with, a.body, a.other) < std::tie(b.with, b.body, b.other);
}

const ReleasedPair* TubeProof::released(const OpenPair& pair) const {
  const auto found = std::lower_bound(
      released_.begin(), released_.end(), pair,
      [](const ReleasedPair& a, const OpenPair& b) { return comes_before(a.pair, b); });
  return found == released_.end() || comes_before(pair, found->pair) ? nullptr : &*found;
}

double TubeProof::required(const OpenPair& pair) const {
  const ReleasedPair* const other = released(pair);
  return other == nullptr ? clearance(pair) + beyond_ : other->distance;
}

bool TubeProof::is_too_close(const OpenPair& pair, const BodyDistance& found) const {
  const ReleasedPair* const other = released(pair);
  if (other == nullptr) return found.upper < found.clearance + beyond_;
  return found.upper < found.clearance && found.lower < other->distance;
}

double TubeProof::smallest_motion(const OpenPair& pair, double resolution) const {
  const double smallest =
      released(pair) == nullptr ? resolution * clearance(pair) : smallest_released_motion;
  return std::max(smallest, 16 * rounding(pair));
}

double TubeProof::displacement(const OpenPair& pair) const {
  if (!is_of_links(pair)) return placed_[pair.body].capsule.bounds.displacement;
  return motion_.displacement(reach(pair.body), bodies_.groups[pair.body].frame,
                              bodies_.groups[pair.other].frame);
}

double TubeProof::rounding(const OpenPair& pair) const {
  const double own = placed_[pair.body].rounding;
  switch (pair.with) {
    case OpenPair::With::link:
    case OpenPair::With::group:
      return own + placed_[pair.other].rounding;
    case OpenPair::With::obstacle:
      return own + support_rounding(bodies_.obstacle_bodies[pair.other].body);
    case OpenPair::With::node:
      return own + bodies_.tree.boxes().rounding_of(pair.other);
  }
  return own;
}

double TubeProof::size_of(std::uint32_t group) const {
  return bodies_.groups[group].is_single() ? 0 : bodies_.groups[group].size;
}

bool TubeProof::is_coarse_group_pair(const OpenPair& pair) const {
  // A pair that rounding alone keeps open is divided too.
  return std::max(size_of(pair.body), size_of(pair.other)) + bodies_.options.clearance +
             16 * rounding(pair) >=
         displacement(pair);
}

bool TubeProof::is_coarse_node(std::uint32_t group, std::uint32_t index) const {
  const Placed& placed = placed_[group];
  const BoxTree::Node& node = bodies_.tree.node(index);
  const double rounding = placed.rounding + bodies_.tree.boxes().rounding_of(index);
  return std::max(size_of(group), node.size) + node.clearance + 16 * rounding >=
         placed.capsule.bounds.displacement;
}

void TubeProof::divide_group_pair(const OpenPair& pair, std::vector<OpenPair>& into) const {
  const CollisionBodies::GroupPair& groups = bodies_.group_pairs[pair.group_pair];
  for (std::uint32_t i = groups.begin; i < groups.end; ++i) {
    const CollisionBodies::SelfPair& bodies = bodies_.self_pairs[i];
    into.push_back({.with = OpenPair::With::link, .body = bodies.first, .other = bodies.second});
  }
}

void TubeProof::search_tree(std::uint32_t group, TreeSearch& search) {
  std::vector<std::uint32_t>& split = scratch_->split;
  split.clear();
  search_nodes(group, search);
  if (split.empty()) return;
  const CollisionBodies::BodyGroup& whole = bodies_.groups[group];
  for (std::uint32_t body = whole.begin; body < whole.end; ++body) {
    search.nodes = split;
    search_nodes(body, search);
  }
}

void TubeProof::search_nodes(std::uint32_t group, TreeSearch& search) {
  place_group(group);
  const Placed& placed = placed_[group];
  std::array<double, boxes_at_once> gaps;
  while (!search.nodes.empty()) {
    const std::size_t count = std::min(boxes_at_once, search.nodes.size());
    std::array<std::uint32_t, boxes_at_once> tested;
    std::copy(search.nodes.end() - static_cast<std::ptrdiff_t>(count), search.nodes.end(),
              tested.begin());
    search.nodes.resize(search.nodes.size() - count);
    box_gaps(placed.capsule, bodies_.tree.boxes(), {tested.data(), count}, gaps);
    for (std::size_t k = 0; k < count; ++k) {
      const double distance = gaps[k] - placed.rounding;
      if (distance >= bodies_.tree.node(tested[k]).clearance + beyond_) {
        search.least_distance = std::min(search.least_distance, distance);
      } else {
        divide_node({.with = OpenPair::With::node, .body = group, .other = tested[k]}, search);
      }
    }
  }
}

/// Adds what a pair of a group and a node consists of, or the pair itself if the motion is larger.
void TubeProof::divide_node(const OpenPair& pair, TreeSearch& search) {
  const BoxTree::Node& node = bodies_.tree.node(pair.other);
  const CollisionBodies::BodyGroup& group = bodies_.groups[pair.body];
  const bool is_leaf = node.right == 0;
  if (is_leaf && bodies_.allowed(bodies_.link_bodies[group.begin],
                                 bodies_.obstacle_bodies[node.body].obstacle)) {
    return;
  }
  if (is_leaf && group.is_single()) {
    search.obstacles.push_back(
        {.with = OpenPair::With::obstacle, .body = pair.body, .other = node.body});
  } else if (!search.all && !is_coarse_node(pair.body, pair.other)) {
    search.open.push_back(pair);
  } else if (is_leaf || (!group.is_single() && group.size >= node.size)) {
    scratch_->split.push_back(pair.other);
  } else {
    search.nodes.push_back(pair.other + 1);
    search.nodes.push_back(node.right);
  }
}

TubeProof::Bound TubeProof::bound(OpenPair& pair) {
  place_both(pair);
  Bound found{nothing_proved, required(pair)};
  const bool is_tried = released(pair) != nullptr;  // the groups have no direction in contact
  switch (pair.with) {
    case OpenPair::With::node:  // search_tree() tests them
      break;
    case OpenPair::With::group:
      found.distance = gap_of_groups(pair);
      break;
    case OpenPair::With::link:
      found.distance = gap_of_groups(pair);
      if (!found.proves() && (is_tried || !is_exact(pair)) && may_improve(pair, found)) {
        improve(pair, found);
      }
      break;
    case OpenPair::With::obstacle:
      found.distance = gap_to_obstacle(pair);
      if (!found.proves() && (is_tried || !is_exact(pair))) improve(pair, found);
      break;
  }
  return found;
}

double TubeProof::gap_of_groups(const OpenPair& pair) const {
  const BoundingCapsule& other = placed_[pair.other].capsule.at_middle;
  const MovingCapsule& first = placed_[pair.body].capsule;
  Vector3 n = towards(first.at_middle, other);
  if (!normalize(n)) return nothing_proved;
  const std::size_t i = bodies_.groups[pair.body].frame, j = bodies_.groups[pair.other].frame;
  const MovingCapsule relative =
      relative_to(motion_.frame(j), motion_.bounds(reach(pair.body), i, j), first);
  return lowest_along(other, n) - highest_along(relative, n) - rounding(pair);
}

double TubeProof::gap_to_obstacle(const OpenPair& pair) const {
  const ConvexBody& obstacle = bodies_.obstacle_bodies[pair.other].body;
  const MovingCapsule& capsule = placed_[pair.body].capsule;
  Vector3 n = -obstacle.axes.col(2);
  if (obstacle.core != ConvexBody::Core::half_space) {
    if (!has_projection(obstacle.core)) return nothing_proved;
    n = towards(capsule.at_middle, obstacle.centre,
                [&](const Vector3& point) { return projection_on_core(obstacle, point); });
    if (!normalize(n)) return nothing_proved;
  }
  return -support(obstacle, -n) - highest_along(capsule, n) - rounding(pair);
}

/// Whether the direction of the groups is the best one at the middle of the tube.
bool TubeProof::is_exact(const OpenPair& pair) const {
  const CollisionBodies::BodyGroup& group = bodies_.groups[pair.body];
  if (!group.is_body) return false;
  if (pair.with == OpenPair::With::link) return bodies_.groups[pair.other].is_body;
  const ConvexBody::Core core = bodies_.obstacle_bodies[pair.other].body.core;
  return core == ConvexBody::Core::half_space ||
         (group.capsule.half_axis.isZero(0) && has_projection(core));
}

/// Whether the bodies of two links may be proved although their capsules are not: less than the
/// capsules' excess is missing, or the motion is so small that nothing else is left to try.
bool TubeProof::may_improve(const OpenPair& pair, const Bound& found) const {
  const double excess = bodies_.groups[pair.body].excess + bodies_.groups[pair.other].excess;
  return found.required - found.distance <= excess ||
         displacement(pair) <= excess + clearance(pair) + 16 * rounding(pair);
}

/// Tries the support values of the bodies themselves along the last direction of the pair and along
/// the one between the nearest points.
void TubeProof::improve(OpenPair& pair, Bound& found) const {
  const bool is_link = pair.with == OpenPair::With::link;
  const CarriedBody& carried = bodies_.link_bodies[pair.body].carried;
  const CarriedBody* const earlier = is_link ? &bodies_.link_bodies[pair.other].carried : nullptr;
  const ConvexBody* const obstacle = is_link ? nullptr : &bodies_.obstacle_bodies[pair.other].body;
  const std::size_t j = is_link ? earlier->frame : 0;
  const double remainder = is_link ? motion_.remainder(reach(pair.body), carried.frame, j)
                                   : placed_[pair.body].capsule.bounds.remainder;
  const Rotation& axes = motion_.frame(j).rotation;
  const auto try_direction = [&](const Vector3& n) {
    const double lowest = is_link ? lowest_along(motion_, *earlier, n) : -support(*obstacle, -n);
    const double highest = highest_along(motion_, carried, j, n, remainder);
    found.distance = std::max(found.distance, lowest - highest - rounding(pair));
    return found.proves();
  };
  if (!pair.direction.isZero(0) && try_direction(axes * pair.direction)) return;
  const ConvexBody first = in_world(motion_, carried);
  const ConvexBody second = is_link ? in_world(motion_, *earlier) : *obstacle;
  const Vector3 between = second.centre - first.centre;
  const double bounds = first.bound + second.bound;
  if (std::isfinite(bounds) && remainder >= between.norm() + bounds) return;  // no n can suffice
  const NearestPoints points = nearest_points(
      first, second, pair.direction.isZero(0) ? between : Vector3(axes * pair.direction));
  pair.direction = axes.transpose() * points.direction;
  try_direction(points.direction);
}

BodyDistance TubeProof::distance(const OpenPair& pair) {
  place_both(pair);
  const bool is_link = pair.with == OpenPair::With::link;
  const auto& link = bodies_.link_bodies[pair.body];
  const ConvexBody first = in_world(motion_, link.carried);
  const ConvexBody second = is_link ? in_world(motion_, bodies_.link_bodies[pair.other].carried)
                                    : bodies_.obstacle_bodies[pair.other].body;
  const Separation parts = separation(first, second, second.centre - first.centre);
  if (!is_link) {
    return bodies_.distance(link, bodies_.obstacle_bodies[pair.other], parts, rounding(pair));
  }
  const std::string& name = bodies_.name_of(bodies_.link_bodies[pair.other]);
  return bodies_.distance(link, name, parts, clearance(pair), rounding(pair));
}

}  // namespace beeline::internal

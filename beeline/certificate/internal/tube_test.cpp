#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/certificate/internal/tube_test.h>

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

}  // namespace

TubeTest::TubeTest(const CollisionBodies& bodies, const Configuration& lower,
                   const Configuration& upper, double beyond)
    : bodies_(bodies), beyond_(beyond), motion_(bodies.motion), placed_(bodies.covers.size()) {
  for (std::size_t i = 0; i < bodies.covers.size(); ++i) {
    const CollisionBodies::Cover& cover = bodies.covers[i];
    if (!cover.reach.of.empty()) continue;
    reach_.resize(bodies.covers.size());
    for (std::uint32_t k = cover.begin; k < cover.end; ++k) {
      const JointReach reach =
          motion_.reach(bodies.link_bodies[k].carried.body, cover.frame, lower, upper);
      reach_[i].of.resize(reach.of.size());
      for (std::size_t l = 0; l < reach.of.size(); ++l) {
        reach_[i].of[l] = std::max(reach_[i].of[l], reach.of[l]);
      }
    }
  }
}

void TubeTest::place(const JointTube& tube) {
  motion_.set(tube);
  ++tube_;
}

const JointReach& TubeTest::reach(std::uint32_t i) const {
  const JointReach& constant = bodies_.covers[i].reach;
  return constant.of.empty() ? reach_[i] : constant;
}

void TubeTest::place_cover(std::uint32_t i) {
  Placed& placed = placed_[i];
  if (placed.tube == tube_) return;
  placed.tube = tube_;
  const CollisionBodies::Cover& cover = bodies_.covers[i];
  const ChainMotion::Frame& frame = motion_.frame(cover.frame);
  placed.capsule = carried_by(frame, cover.capsule, motion_.bounds(reach(i), cover.frame, 0));
  placed.rounding = motion_.rounding(cover.frame, cover.magnitude);
}

void TubeTest::place_both(const OpenPair& pair) {
  place_cover(pair.body);
  if (is_of_links(pair)) place_cover(pair.other);
}

bool TubeTest::is_of_links(const OpenPair& pair) const {
  return pair.with == OpenPair::With::link || pair.with == OpenPair::With::group;
}

double TubeTest::clearance(const OpenPair& pair) const {
  switch (pair.with) {
    case OpenPair::With::link:
    case OpenPair::With::group:
      return bodies_.clearance;
    case OpenPair::With::obstacle:
      return bodies_.obstacle_bodies[pair.other].clearance;
    case OpenPair::With::node:
      return bodies_.tree.node(pair.other).clearance;
  }
  return bodies_.clearance;
}

double TubeTest::displacement(const OpenPair& pair) const {
  if (!is_of_links(pair)) return placed_[pair.body].capsule.bounds.displacement;
  return motion_.displacement(reach(pair.body), bodies_.covers[pair.body].frame,
                              bodies_.covers[pair.other].frame);
}

double TubeTest::rounding(const OpenPair& pair) const {
  const double own = placed_[pair.body].rounding;
  switch (pair.with) {
    case OpenPair::With::link:
    case OpenPair::With::group:
      return own + placed_[pair.other].rounding;
    case OpenPair::With::obstacle:
      return own + support_rounding(bodies_.obstacle_bodies[pair.other].body);
    case OpenPair::With::node:
      return own + bodies_.tree.rows()[pair.other].rounding;
  }
  return own;
}

double TubeTest::size_of(std::uint32_t cover) const {
  return bodies_.covers[cover].is_single() ? 0 : bodies_.covers[cover].size;
}

bool TubeTest::is_coarse_group(const OpenPair& pair) const {
  // A pair that rounding alone keeps open is divided too.
  return std::max(size_of(pair.body), size_of(pair.other)) + bodies_.clearance +
             16 * rounding(pair) >=
         displacement(pair);
}

bool TubeTest::is_coarse_node(std::uint32_t cover, std::uint32_t index) const {
  const Placed& placed = placed_[cover];
  const BoxTree::Node& node = bodies_.tree.node(index);
  const double rounding = placed.rounding + bodies_.tree.rows()[index].rounding;
  return std::max(size_of(cover), node.size) + node.clearance + 16 * rounding >=
         placed.capsule.bounds.displacement;
}

void TubeTest::divide_group(const OpenPair& pair, std::vector<OpenPair>& into) const {
  const CollisionBodies::SelfGroup& group = bodies_.self_groups[pair.group];
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const CollisionBodies::SelfPair& bodies = bodies_.self_pairs[i];
    into.push_back({.with = OpenPair::With::link, .body = bodies.first, .other = bodies.second});
  }
}

void TubeTest::search_tree(std::uint32_t cover, TreeSearch& search) {
  split_.clear();
  search_nodes(cover, search);
  if (split_.empty()) return;
  const CollisionBodies::Cover& whole = bodies_.covers[cover];
  for (std::uint32_t body = whole.begin; body < whole.end; ++body) {
    search.nodes = split_;
    search_nodes(body, search);
  }
}

void TubeTest::search_nodes(std::uint32_t cover, TreeSearch& search) {
  place_cover(cover);
  const Placed& placed = placed_[cover];
  std::array<double, boxes_at_once> gaps;
  while (!search.nodes.empty()) {
    const std::size_t count = std::min(boxes_at_once, search.nodes.size());
    std::array<std::uint32_t, boxes_at_once> tested;
    std::copy(search.nodes.end() - static_cast<std::ptrdiff_t>(count), search.nodes.end(),
              tested.begin());
    search.nodes.resize(search.nodes.size() - count);
    box_gaps(placed.capsule, bodies_.tree.rows(), {tested.data(), count}, gaps);
    for (std::size_t k = 0; k < count; ++k) {
      const double distance = gaps[k] - placed.rounding;
      if (distance >= bodies_.tree.node(tested[k]).clearance + beyond_) {
        search.least_distance = std::min(search.least_distance, distance);
      } else {
        divide_node({.with = OpenPair::With::node, .body = cover, .other = tested[k]}, search);
      }
    }
  }
}

/// Adds what a pair of a cover and a node consists of, or the pair itself if the motion is larger.
void TubeTest::divide_node(const OpenPair& pair, TreeSearch& search) {
  const BoxTree::Node& node = bodies_.tree.node(pair.other);
  const CollisionBodies::Cover& cover = bodies_.covers[pair.body];
  const bool is_leaf = node.right == 0;
  if (is_leaf && bodies_.allowed(bodies_.link_bodies[cover.begin],
                                 bodies_.obstacle_bodies[node.body].obstacle)) {
    return;
  }
  if (is_leaf && cover.is_single()) {
    search.obstacles.push_back(
        {.with = OpenPair::With::obstacle, .body = pair.body, .other = node.body});
  } else if (!search.all && !is_coarse_node(pair.body, pair.other)) {
    search.open.push_back(pair);
  } else if (is_leaf || (!cover.is_single() && cover.size >= node.size)) {
    split_.push_back(pair.other);
  } else {
    search.nodes.push_back(pair.other + 1);
    search.nodes.push_back(node.right);
  }
}

TubeTest::Bound TubeTest::bound(OpenPair& pair) {
  place_both(pair);
  Bound found{nothing_proved, clearance(pair) + beyond_};
  switch (pair.with) {
    case OpenPair::With::node:  // search_tree() tests them
      break;
    case OpenPair::With::group:
      found.distance = gap_of_covers(pair);
      break;
    case OpenPair::With::link:
      found.distance = gap_of_covers(pair);
      if (!found.proves() && !is_exact(pair)) improve(pair, found);
      break;
    case OpenPair::With::obstacle:
      found.distance = gap_to_obstacle(pair);
      if (!found.proves() && !is_exact(pair)) improve(pair, found);
      break;
  }
  return found;
}

double TubeTest::gap_of_covers(const OpenPair& pair) const {
  const BoundingCapsule& other = placed_[pair.other].capsule.at_middle;
  const MovingCapsule& first = placed_[pair.body].capsule;
  Vector3 n = towards(first.at_middle, other);
  if (!normalize(n)) return nothing_proved;
  const std::size_t i = bodies_.covers[pair.body].frame, j = bodies_.covers[pair.other].frame;
  const MovingCapsule relative =
      relative_to(motion_.frame(j), motion_.bounds(reach(pair.body), i, j), first);
  return lowest_along(other, n) - highest_along(relative, n) - rounding(pair);
}

double TubeTest::gap_to_obstacle(const OpenPair& pair) const {
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

/// Whether the direction of the covers is the best one at the middle of the tube.
bool TubeTest::is_exact(const OpenPair& pair) const {
  const CollisionBodies::Cover& cover = bodies_.covers[pair.body];
  if (!cover.is_body) return false;
  if (pair.with == OpenPair::With::link) return bodies_.covers[pair.other].is_body;
  const ConvexBody::Core core = bodies_.obstacle_bodies[pair.other].body.core;
  return core == ConvexBody::Core::half_space ||
         (cover.capsule.half.isZero(0) && has_projection(core));
}

/// Tries the support values of the bodies themselves along the last direction of the pair and along
/// the one between the nearest points.
void TubeTest::improve(OpenPair& pair, Bound& found) const {
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

BodyDistance TubeTest::distance(const OpenPair& pair) {
  place_both(pair);
  const bool is_link = pair.with == OpenPair::With::link;
  const auto& link = bodies_.link_bodies[pair.body];
  const ConvexBody first = in_world(motion_, link.carried);
  const ConvexBody second = is_link ? in_world(motion_, bodies_.link_bodies[pair.other].carried)
                                    : bodies_.obstacle_bodies[pair.other].body;
  const Separation parts = separation(first, second, second.centre - first.centre);
  const std::string& name = is_link ? bodies_.name_of(bodies_.link_bodies[pair.other])
                                    : bodies_.name_of(bodies_.obstacle_bodies[pair.other]);
  return bodies_.distance(link, name, parts, clearance(pair), rounding(pair));
}

}  // namespace beeline::internal

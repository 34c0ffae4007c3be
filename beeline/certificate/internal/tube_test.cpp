#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/certificate/internal/tube_test.h>

namespace beeline::internal {
namespace {

constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

double box_rounding(const AlignedBox& box) {
  return 32 * machine_epsilon * (box.centre.cwiseAbs().sum() + box.half.sum());
}

}  // namespace

TubeTest::TubeTest(const CollisionBodies& bodies, const Configuration& lower,
                   const Configuration& upper, double beyond)
    : bodies_(bodies), beyond_(beyond), motion_(bodies.motion), placed_(bodies.link_bodies.size()) {
  for (std::size_t i = 0; i < bodies.link_bodies.size(); ++i) {
    const auto& link = bodies.link_bodies[i];
    if (!link.reach.of.empty()) continue;
    reach_.resize(bodies.link_bodies.size());
    reach_[i] = motion_.reach(link.carried.body, link.carried.frame, lower, upper);
  }
}

void TubeTest::place(const JointTube& tube) {
  motion_.set(tube);
  ++tube_;
}

const JointReach& TubeTest::reach(std::uint32_t i) const {
  const JointReach& constant = bodies_.link_bodies[i].reach;
  return constant.of.empty() ? reach_[i] : constant;
}

void TubeTest::place_body(std::uint32_t i) {
  if (placed_[i].tube == tube_) return;
  const CarriedBody& carried = bodies_.link_bodies[i].carried;
  const ChainMotion::Frame& frame = motion_.frame(carried.frame);
  placed_[i] = {tube_, frame.origin + frame.rotation * carried.body.centre,
                motion_.displacement(reach(i), carried.frame, 0),
                motion_.rounding(carried.frame, magnitude(carried.body)), -1};
}

void TubeTest::place_bodies(const OpenPair& pair) {
  place_body(pair.body);
  if (pair.with == OpenPair::With::link) place_body(pair.other);
}

double TubeTest::remainder(std::uint32_t i, std::size_t j) {
  const std::size_t frame = bodies_.link_bodies[i].carried.frame;
  if (j > 0) return motion_.remainder(reach(i), frame, j);
  double& to_base = placed_[i].remainder;
  if (to_base < 0) to_base = motion_.remainder(reach(i), frame, 0);
  return to_base;
}

double TubeTest::clearance(const OpenPair& pair) const {
  switch (pair.with) {
    case OpenPair::With::link:
      return bodies_.clearance;
    case OpenPair::With::obstacle:
      return bodies_.obstacle_bodies[pair.other].clearance;
    case OpenPair::With::node:
      return bodies_.tree.node(pair.other).clearance;
  }
  return bodies_.clearance;
}

double TubeTest::displacement(const OpenPair& pair) const {
  if (pair.with != OpenPair::With::link) return placed_[pair.body].displacement;
  return motion_.displacement(reach(pair.body), bodies_.link_bodies[pair.body].carried.frame,
                              bodies_.link_bodies[pair.other].carried.frame);
}

double TubeTest::rounding(const OpenPair& pair) const {
  const double own = placed_[pair.body].rounding;
  switch (pair.with) {
    case OpenPair::With::link:
      return own + placed_[pair.other].rounding;
    case OpenPair::With::obstacle:
      return own + support_rounding(bodies_.obstacle_bodies[pair.other].body);
    case OpenPair::With::node:
      return own + box_rounding(bodies_.tree.node(pair.other).box);
  }
  return own;
}

bool TubeTest::is_coarse(const OpenPair& pair) const {
  if (pair.with != OpenPair::With::node) return false;
  const BoxTree::Node& node = bodies_.tree.node(pair.other);
  return node.right == 0 ||
         node.box.half.norm() + node.clearance >= placed_[pair.body].displacement;
}

TubeTest::Bound TubeTest::bound(OpenPair& pair) {
  place_bodies(pair);
  return pair.with == OpenPair::With::node ? bound_to_node(pair) : bound_to_body(pair);
}

/// The direction is from the body's centre to the nearest point of the box.
TubeTest::Bound TubeTest::bound_to_node(OpenPair& pair) {
  const BoxTree::Node& node = bodies_.tree.node(pair.other);
  const Placed& placed = placed_[pair.body];
  const CarriedBody& carried = bodies_.link_bodies[pair.body].carried;
  Bound found{-std::numeric_limits<double>::infinity(), clearance(pair) + beyond_};
  const Vector3 beside = placed.centre - node.box.centre;
  const Vector3 towards = beside.cwiseMax(-node.box.half).cwiseMin(node.box.half) - beside;
  const double distance = towards.norm();
  if (!(distance > 0)) return found;
  found.distance = distance - carried.body.bound - placed.displacement - rounding(pair);
  if (found.proves()) return found;
  const double remainder = this->remainder(pair.body, 0);
  if (distance <= remainder + found.required) return found;
  pair.direction = towards / distance;
  const double lowest =
      pair.direction.dot(node.box.centre) - pair.direction.cwiseAbs().dot(node.box.half);
  const double highest = highest_along(motion_, carried, 0, pair.direction, remainder);
  found.distance = std::max(found.distance, lowest - highest - rounding(pair));
  return found;
}

TubeTest::Bound TubeTest::bound_to_body(OpenPair& pair) {
  const bool is_link = pair.with == OpenPair::With::link;
  const Placed& placed = placed_[pair.body];
  const CarriedBody& carried = bodies_.link_bodies[pair.body].carried;
  const CarriedBody* const earlier = is_link ? &bodies_.link_bodies[pair.other].carried : nullptr;
  const ConvexBody* const obstacle = is_link ? nullptr : &bodies_.obstacle_bodies[pair.other].body;
  const std::size_t j = is_link ? earlier->frame : 0;
  Bound found{-std::numeric_limits<double>::infinity(), clearance(pair) + beyond_};

  // Spheres around both.
  const Vector3 between = (is_link ? placed_[pair.other].centre : obstacle->centre) - placed.centre;
  const double apart = between.norm();
  const double bounds = carried.body.bound + (is_link ? earlier->body.bound : obstacle->bound);
  found.distance = apart - bounds - displacement(pair) - rounding(pair);
  if (found.proves()) return found;

  const double remainder = this->remainder(pair.body, j);
  const Rotation& axes = motion_.frame(j).rotation;
  const auto try_direction = [&](const Vector3& n) {
    const double lowest = is_link ? lowest_along(motion_, *earlier, n) : -support(*obstacle, -n);
    const double highest = highest_along(motion_, carried, j, n, remainder);
    found.distance = std::max(found.distance, lowest - highest - rounding(pair));
    return found.proves();
  };
  if (!pair.direction.isZero(0) && try_direction(axes * pair.direction)) return found;
  if (std::isfinite(bounds) && remainder >= apart + bounds) return found;  // no n can suffice
  const ConvexBody first = in_world(motion_, carried);
  const NearestPoints points =
      nearest_points(first, is_link ? in_world(motion_, *earlier) : *obstacle,
                     pair.direction.isZero(0) ? between : Vector3(axes * pair.direction));
  pair.direction = axes.transpose() * points.direction;
  try_direction(points.direction);
  return found;
}

BodyDistance TubeTest::distance(const OpenPair& pair) {
  place_bodies(pair);
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

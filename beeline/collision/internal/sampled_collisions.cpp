#include <bit>
#include <limits>

#include <beeline/collision/internal/sampled_collisions.h>
#include <beeline/model/internal/chain.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/collision/internal/sampled_collisions.cpp"
#include <hwy/foreach_target.h>

#include <beeline/kinematics/chain-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::CollisionBodies;
using internal::ConvexBody;
using internal::SampledCollisions;

HWY_INLINE Vector same(const Vector3& v) { return {Lanes(v.x()), Lanes(v.y()), Lanes(v.z())}; }

HWY_INLINE Lanes clamped(Lanes v, Lanes limit) { return min(max(v, -limit), limit); }

/// A capsule at eight configurations.
struct LaneCapsule {
  Vector centre, half_axis;
  double radius = 0;
  bool is_sphere = true;

  /// The point of the segment nearest to a point.
  HWY_INLINE Vector nearest(const Vector& point) const {
    if (is_sphere) return centre;
    const Lanes along = dot(point - centre, half_axis) / dot(half_axis, half_axis);
    return fma(clamped(along, Lanes(1)), half_axis, centre);
  }
  /// The maximum of n . x over the segment.
  HWY_INLINE Lanes highest(const Vector& n) const {
    const Lanes middle = dot(n, centre);
    return is_sphere ? middle : middle + abs(dot(n, half_axis));
  }
};

/// The core of an obstacle, at rest, in its own axes. A hull is replaced by the sphere around it.
struct LaneCore {
  ConvexBody::Core kind = ConvexBody::Core::point;
  Vector half;

  HWY_INLINE Vector nearest(const Vector& p) const {
    using Core = ConvexBody::Core;
    const Lanes zero(0);
    switch (kind) {
      case Core::point:
        break;
      case Core::segment:
        return {zero, zero, clamped(p.z, half.z)};
      case Core::box:
        return {clamped(p.x, half.x), clamped(p.y, half.y), clamped(p.z, half.z)};
      case Core::cylinder: {
        const Lanes away = sqrt(fma(p.x, p.x, p.y * p.y));
        const Lanes scale = choose(away > half.x, half.x / away, Lanes(1));
        return {scale * p.x, scale * p.y, clamped(p.z, half.z)};
      }
      case Core::half_space:
      case Core::hull:
        break;  // bounds_of() does not make a LaneCore of these
    }
    return {zero, zero, zero};
  }
  /// The maximum of n . x over the core.
  HWY_INLINE Lanes highest(const Vector& n) const {
    using Core = ConvexBody::Core;
    const Lanes along = abs(n.z) * half.z;
    switch (kind) {
      case Core::point:
        return 0;
      case Core::segment:
        return along;
      case Core::box:
        return fma(abs(n.x), half.x, fma(abs(n.y), half.y, along));
      case Core::cylinder:
        return fma(half.x, sqrt(fma(n.x, n.x, n.y * n.y)), along);
      case Core::half_space:
      case Core::hull:
        break;
    }
    return std::numeric_limits<double>::infinity();
  }
};

/// The distance of two bodies is `lower` or more. It is `upper` or less if both are given exactly.
struct DistanceBounds {
  Lanes lower, upper;
};

/// The bounds from three projections (Cheney and Goldstein, "Proximity maps for convex sets",
/// 1959) of a capsule and another convex body.
template <class Body>
HWY_INLINE DistanceBounds bounds(const LaneCapsule& capsule, const Body& body, const Vector& centre,
                                 double radius, bool nearest_is_exact) {
  Vector point = capsule.nearest(centre);
  Vector other = body.nearest(point);
  if (!capsule.is_sphere) {
    for (int i = 0; i < 2; ++i) {
      point = capsule.nearest(other);
      other = body.nearest(point);
    }
  }
  const Vector between = other - point;
  const Lanes length = sqrt(dot(between, between));
  const Lanes upper = length - Lanes(radius + capsule.radius);
  if (capsule.is_sphere && nearest_is_exact) return {upper, upper};
  const Vector n = (Lanes(1) / max(length, Lanes(1e-100))) * between;
  return {-body.highest(-Lanes(1) * n) - capsule.highest(n) - Lanes(radius + capsule.radius),
          upper};
}

/// Tests all pairs at eight configurations, and leaves open those that their capsules do not
/// decide.
class LaneTest {
 public:
  LaneTest(const CollisionBodies& bodies, SampledCollisions::Found& found)
      : bodies_(bodies), found_(found) {}

  HWY_INLINE void place(const double* q) {
    const internal::Chain& chain = internal::chain_of(bodies_.arm);
    found_.frames.resize(chain.links.size() + 1);
    store(LanePose::identity(), 0);
    const Vector away = same(bodies_.motion.origin());
    std::size_t i = 0;
    frames_along(chain, q, [&](LanePose frame) HWY_ATTR {
      frame.origin = frame.origin - away;
      store(frame, ++i);
    });
  }

  HWY_INLINE void test_obstacles() {
    for (const std::uint32_t whole : bodies_.link_groups) {
      const CollisionBodies::BodyGroup& group = bodies_.groups[whole];
      if (group.frame == 0) continue;  // link 0 does not move
      const LaneCapsule capsule = placed(group);
      if (!bodies_.tree.empty()) search_tree(group, capsule);
      for (std::size_t i = bodies_.finite_obstacles; i < bodies_.obstacle_bodies.size(); ++i) {
        test_group(group, capsule, static_cast<std::uint32_t>(i), found_.open);
      }
      if (found_.open == 0) return;
    }
  }

  HWY_INLINE void test_links() {
    for (const CollisionBodies::GroupPair& pair : bodies_.group_pairs) {
      const auto &first = bodies_.groups[pair.first], &second = bodies_.groups[pair.second];
      const double clearance = bodies_.options.clearance;
      unsigned lanes = found_.open;
      if (!first.is_single() || !second.is_single()) {
        const LaneCapsule b = placed(second);
        const DistanceBounds gap = bounds(placed(first), b, b.centre, b.radius, false);
        lanes &= bits(gap.lower < Lanes(clearance));
      }
      for (std::uint32_t i = pair.begin; i < pair.end && lanes != 0; ++i) {
        const auto [body, other] = bodies_.self_pairs[i];
        const auto &a = bodies_.groups[body], &b = bodies_.groups[other];
        const LaneCapsule capsule = placed(b);
        const DistanceBounds gap = bounds(placed(a), capsule, capsule.centre, capsule.radius, true);
        decide({body, other, true, lanes}, gap, clearance, a.is_body && b.is_body);
        lanes &= found_.open;
      }
      if (found_.open == 0) return;
    }
  }

 private:
  HWY_INLINE void store(const LanePose& frame, std::size_t i) {
    double* rows = found_.frames[i].data();
    frame.x.store(rows);
    frame.y.store(rows + 3 * lane_count);
    frame.z.store(rows + 6 * lane_count);
    frame.origin.store(rows + 9 * lane_count);
  }

  HWY_INLINE LanePose frame(std::size_t i) const {
    const double* rows = found_.frames[i].data();
    return {Vector::load(rows), Vector::load(rows + 3 * lane_count),
            Vector::load(rows + 6 * lane_count), Vector::load(rows + 9 * lane_count)};
  }

  HWY_INLINE LaneCapsule placed(const CollisionBodies::BodyGroup& group) const {
    const LanePose at = frame(group.frame);
    const bool is_sphere = group.capsule.half_axis.isZero(0);
    return {at.origin + from_axes(at, same(group.capsule.centre)),
            is_sphere ? same(Vector3::Zero()) : from_axes(at, same(group.capsule.half_axis)),
            group.capsule.radius, is_sphere};
  }

  HWY_INLINE void search_tree(const CollisionBodies::BodyGroup& group, const LaneCapsule& capsule) {
    found_.nodes.assign(1, 0);
    while (!found_.nodes.empty()) {
      const std::uint32_t i = found_.nodes.back();
      found_.nodes.pop_back();
      const internal::BoxTree::Node& node = bodies_.tree.node(i);
      const Vector half = same(node.box.half_extents);
      const Vector p = capsule.centre - same(node.box.centre);
      const Vector beyond =
          p - Vector{clamped(p.x, half.x), clamped(p.y, half.y), clamped(p.z, half.z)};
      const double reach = group.size + node.clearance;
      const unsigned near = bits(dot(beyond, beyond) < Lanes(reach * reach)) & found_.open;
      if (near == 0) continue;
      if (node.right == 0) {
        test_group(group, capsule, node.body, near);
      } else {
        found_.nodes.push_back(node.right);
        found_.nodes.push_back(i + 1);
      }
    }
  }

  HWY_INLINE void test_group(const CollisionBodies::BodyGroup& group, const LaneCapsule& capsule,
                             std::uint32_t index, unsigned lanes) {
    const CollisionBodies::ObstacleBody& obstacle = bodies_.obstacle_bodies[index];
    if (bodies_.allowed(bodies_.link_bodies[group.begin], obstacle.obstacle)) return;
    const bool is_exact = is_itself_in_lanes(obstacle.body.core);
    if (!group.is_single()) {
      const DistanceBounds gap = bounds_of(capsule, obstacle.body);
      lanes &= bits(gap.lower < Lanes(obstacle.clearance));
    }
    for (std::uint32_t i = group.begin; i < group.end && lanes != 0; ++i) {
      const CollisionBodies::BodyGroup& body = bodies_.groups[i];
      const DistanceBounds gap =
          bounds_of(group.is_single() ? capsule : placed(body), obstacle.body);
      decide({i, index, false, lanes}, gap, obstacle.clearance, body.is_body && is_exact);
      lanes &= found_.open;
    }
  }

  /// Whether bounds_of() is of the body itself; if not, of a larger one.
  static bool is_itself_in_lanes(ConvexBody::Core core) {
    switch (core) {
      case ConvexBody::Core::point:
      case ConvexBody::Core::segment:
      case ConvexBody::Core::box:
      case ConvexBody::Core::cylinder:
      case ConvexBody::Core::half_space:
        return true;
      case ConvexBody::Core::hull:
        break;
    }
    return false;
  }

  HWY_INLINE DistanceBounds bounds_of(LaneCapsule capsule, const ConvexBody& body) const {
    using Core = ConvexBody::Core;
    if (body.core == Core::half_space) {
      const Vector normal = same(body.axes.col(2));
      const Lanes height = -capsule.highest(-Lanes(1) * normal) -
                           Lanes(body.axes.col(2).dot(body.origin) + body.radius + capsule.radius);
      return {height, height};
    }
    if (!is_itself_in_lanes(body.core)) {  // the sphere around it
      capsule.centre = capsule.centre - same(body.centre);
      const Vector centre = same(Vector3::Zero());
      return bounds(capsule, LaneCore{Core::point, centre}, centre, body.bound, true);
    }
    const Vector x = same(body.axes.col(0)), y = same(body.axes.col(1)), z = same(body.axes.col(2));
    const Vector p = capsule.centre - same(body.origin), u = capsule.half_axis;
    capsule.centre = {dot(x, p), dot(y, p), dot(z, p)};
    if (!capsule.is_sphere) capsule.half_axis = {dot(x, u), dot(y, u), dot(z, u)};
    return bounds(capsule, LaneCore{body.core, same(body.half_extents)}, same(Vector3::Zero()),
                  body.radius, true);
  }

  /// Closes the configurations from the first that is blocked on, or keeps the pair.
  HWY_INLINE void decide(SampledCollisions::OpenPair pair, const DistanceBounds& gap,
                         double clearance, bool is_exact) {
    pair.configurations &= bits(gap.lower < Lanes(clearance));
    if (pair.configurations == 0) return;
    if (is_exact) {
      const unsigned blocked = pair.configurations & bits(gap.upper < Lanes(clearance));
      if (blocked != 0) found_.open &= (blocked & (0 - blocked)) - 1;
      pair.configurations &= ~blocked & found_.open;
      if (pair.configurations == 0) return;
    }
    found_.pairs.push_back(pair);
  }

  const CollisionBodies& bodies_;
  SampledCollisions::Found& found_;
};

void test_in_lanes(const CollisionBodies& bodies, const double* q,
                   SampledCollisions::Found& found) {
  LaneTest test(bodies, found);
  test.place(q);
  test.test_obstacles();
  if (found.open != 0) test.test_links();
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(test_in_lanes);

namespace internal {

SampledCollisions::SampledCollisions(const CollisionBodies& bodies) : bodies_(bodies) {}

int SampledCollisions::first_blocked(const double* q) {
  found_.open = (1U << at_once) - 1;
  found_.pairs.clear();
  HWY_DYNAMIC_DISPATCH(test_in_lanes)(bodies_, q, found_);
  for (const OpenPair& pair : found_.pairs) {
    for (unsigned left = pair.configurations & found_.open; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      if (!is_blocked(pair, static_cast<std::size_t>(k))) continue;
      found_.open &= (1U << k) - 1;
      break;
    }
  }
  return std::popcount(found_.open);
}

bool SampledCollisions::is_blocked(const OpenPair& pair, std::size_t k) const {
  const ConvexBody body = placed(pair.body, k);
  if (pair.is_of_links) {
    const ConvexBody other = placed(pair.other, k);
    return are_closer(body, other, bodies_.options.clearance, other.centre - body.centre);
  }
  const CollisionBodies::ObstacleBody& obstacle = bodies_.obstacle_bodies[pair.other];
  const Vector3 nearest = has_projection(obstacle.body.core)
                              ? projection_on_core(obstacle.body, body.centre)
                              : obstacle.body.centre;
  return are_closer(body, obstacle.body, obstacle.clearance, nearest - body.centre);
}

ConvexBody SampledCollisions::placed(std::uint32_t body, std::size_t k) const {
  const CarriedBody& carried = bodies_.link_bodies[body].carried;
  const double* rows = found_.frames[carried.frame].data() + k;
  const auto vector = [&](std::size_t i) {
    return Vector3(rows[at_once * i], rows[at_once * (i + 1)], rows[at_once * (i + 2)]);
  };
  Rotation rotation;
  rotation << vector(0), vector(3), vector(6);
  return moved(rotation, vector(9), carried.body);
}

}  // namespace internal
}  // namespace beeline
#endif

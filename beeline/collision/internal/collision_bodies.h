#pragma once

#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/box_tree.h>
#include <beeline/collision/internal/separation.h>
#include <beeline/collision/internal/tube_gap.h>

namespace beeline::internal {

/// The bodies of a CollisionModel: convex bodies of links and obstacles, and the pairs that count.
struct CollisionBodies {
  CollisionBodies(const Arm& moving, const std::vector<LinkShapes>& shapes, const Scene& around,
                  double distance)
      : arm(moving), links(shapes), scene(around), clearance(distance) {}
  CollisionBodies(const CollisionBodies&) = delete;
  CollisionBodies& operator=(const CollisionBodies&) = delete;

  Arm arm;
  std::vector<LinkShapes> links;          ///< the bodies' hulls refer to their vertices
  Scene scene;                            ///< likewise
  double clearance = 0;                   ///< of pairs of links
  ChainMotion motion = ChainMotion(arm);  ///< at zero; questions work on copies

  struct LinkBody {
    CarriedBody carried;
    std::size_t link_shapes = 0;  ///< index of its LinkShapes
    /// The reach for all configurations; empty if joints in front of the body slide.
    JointReach reach = {};
  };
  std::vector<LinkBody> link_bodies;

  struct ObstacleBody {
    ConvexBody body;  ///< in the world's axes, from the origin of link 0
    std::size_t obstacle = 0;
    double clearance = 0;
  };
  /// The bodies of finite size first, in the order of the tree's bodies, then half-spaces.
  std::vector<ObstacleBody> obstacle_bodies;
  std::size_t finite_obstacles = 0;
  BoxTree tree;

  /// A pair of two bodies of the arm; the first is carried by the later link.
  struct SelfPair {
    std::uint32_t first = 0, second = 0;
  };
  std::vector<SelfPair> self_pairs;

  /// Pairs that keep their clearance wherever the coordinates are between `apart_lower` and
  /// `apart_upper`: the position limits, widened by `apart_margin`, or infinite.
  std::vector<SelfPair> apart_pairs;
  Configuration apart_lower, apart_upper;
  static constexpr double apart_margin = 1e-6;
  bool keeps_apart(const ConfigurationRef& q) const {
    if (apart_pairs.empty()) return true;
    return (q.array() >= apart_lower.array()).all() && (q.array() <= apart_upper.array()).all();
  }

  /// Allowed pairs of LinkShapes and obstacles, one bit for each: link_shapes * obstacles +
  /// obstacle.
  std::vector<bool> obstacle_allowed;
  bool allowed(const LinkBody& link, std::size_t obstacle) const {
    return obstacle_allowed[link.link_shapes * scene.obstacles.size() + obstacle];
  }

  /// Whether the pairs of the link's body with obstacles count: link 0 does not move.
  static bool meets_obstacles(const LinkBody& link) { return link.carried.frame > 0; }

  const std::string& name_of(const LinkBody& body) const { return links[body.link_shapes].name; }
  const std::string& name_of(const ObstacleBody& body) const {
    return scene.obstacles[body.obstacle].name;
  }

  /// Returns the distance of a link's body from another one, from their separation in the world's
  /// axes, whose positions are wrong by `rounding`. Without the gradient.
  BodyDistance distance(const LinkBody& first, const std::string& second,
                        const Separation& separation, double kept, double rounding) const {
    return {.names = {name_of(first), second},
            .lower = separation.lower - rounding,
            .upper = separation.upper + rounding,
            .clearance = kept,
            .on_first = separation.points.on_a + motion.origin(),
            .on_second = separation.points.on_b + motion.origin(),
            .normal = separation.points.direction};
  }
};

}  // namespace beeline::internal

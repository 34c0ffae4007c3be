#pragma once

#include <limits>

#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/bounding_capsule.h>
#include <beeline/collision/internal/box_tree.h>
#include <beeline/collision/internal/separation.h>
#include <beeline/collision/internal/tube_gap.h>

namespace beeline::internal {

/// The bodies of a CollisionModel: convex bodies of links and obstacles, and the pairs that count.
struct CollisionBodies {
  CollisionBodies(const Arm& moving, const std::vector<LinkShapes>& shapes, const Scene& around,
                  const CollisionOptions& asked)
      : arm(moving),
        links(shapes),
        scene(around),
        options{.clearance = asked.clearance,
                .self_collision = asked.self_collision,
                .allowed_pairs = asked.allowed_pairs,
                .budget = {.max_work = asked.budget.max_work}} {}
  CollisionBodies(const CollisionBodies&) = delete;
  CollisionBodies& operator=(const CollisionBodies&) = delete;

  Arm arm;
  std::vector<std::string> joint_names = arm.joint_names();
  std::vector<LinkShapes> links;          ///< the bodies' hulls refer to their vertices
  Scene scene;                            ///< likewise
  CollisionOptions options;               ///< of its budget only the limit of work
  ChainMotion motion = ChainMotion(arm);  ///< at zero; questions work on copies

  struct LinkBody {
    CarriedBody carried;
    std::size_t link_shapes = 0;  ///< index of its LinkShapes
    /// The reach for all configurations; empty if joints in front of the body slide.
    JointReach reach = {};
  };
  std::vector<LinkBody> link_bodies;

  /// A group of bodies: the bodies of one LinkShapes from index `begin` to before `end`, with a
  /// capsule around them. First in `groups` are the groups of one body, at the index of the body;
  /// the groups of all bodies of a LinkShapes that has several follow.
  struct BodyGroup {
    BoundingCapsule capsule;  ///< in the frame that carries it
    std::size_t frame = 0, link_shapes = 0;
    std::uint32_t begin = 0, end = 0;
    double size = 0;        ///< of the capsule
    double magnitude = 0;   ///< of the bodies and of the capsule, for rounding
    bool is_body = false;   ///< whether the capsule is the one body
    double excess = 0;      ///< estimated_excess() over the body, if it is one
    JointReach reach = {};  ///< the largest of the bodies; empty if joints in front slide

    bool is_single() const { return end == begin + 1; }
  };
  std::vector<BodyGroup> groups;
  std::vector<std::uint32_t> link_groups;  ///< the group of all bodies of each LinkShapes with any

  static constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();
  struct ObstacleBody {
    ConvexBody body;  ///< in the world's axes, from the origin of link 0
    std::size_t obstacle = 0;
    double clearance = 0;
    std::uint32_t point = no_point;  ///< index in the obstacle's cloud, if it is a point of it
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
  /// Two groups of all bodies of a LinkShapes. The pairs of their bodies that count are from
  /// `begin` to before `end` in self_pairs.
  struct GroupPair {
    std::uint32_t first = 0, second = 0;  ///< indices in `groups`
    std::uint32_t begin = 0, end = 0;
  };
  std::vector<GroupPair> group_pairs;

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

  std::size_t pair_count = 0;  ///< CollisionModel::pair_count()

  /// Sets `groups`, `link_groups`, `group_pairs`, in whose order it puts self_pairs, and
  /// `pair_count` from the other members.
  void set_groups();

  /// Whether the pairs of the link's body with obstacles count: link 0 does not move, so no
  /// configuration changes whether it may stand there, and it touches what it is mounted on. Where
  /// the mount is searched, base_blocked_by() tests it.
  static bool meets_obstacles(const LinkBody& link) { return link.carried.frame > 0; }

  const std::string& name_of(const LinkBody& body) const { return links[body.link_shapes].name; }
  const std::string& name_of(const ObstacleBody& body) const {
    return scene.obstacles[body.obstacle].name;
  }

  /// Returns the distance of a link's body from an obstacle's, see the function below.
  BodyDistance distance(const LinkBody& first, const ObstacleBody& second,
                        const Separation& separation, double rounding) const {
    BodyDistance found = distance(first, name_of(second), separation, second.clearance, rounding);
    if (second.point != no_point) found.point = second.point;
    return found;
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

/// Returns the model of the arm with further bodies, which its last link carries, in another scene.
/// What `model` knows of the pairs of its links is kept; the obstacles are prepared anew. The
/// options must have the same clearance and allow none of these pairs.
CollisionModel with_carried(const CollisionModel& model, const std::vector<LinkShapes>& parts,
                            const Scene& scene, const CollisionOptions& options);

}  // namespace beeline::internal

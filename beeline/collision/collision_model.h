#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/collision/scene.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/reason.h>

namespace beeline {
class CollisionModel;
struct CollisionOptions;

namespace internal {
struct CollisionBodies;
CollisionModel with_carried(const CollisionModel& model, const std::vector<LinkShapes>& parts,
                            const Scene& scene, const CollisionOptions& options);
}  // namespace internal

struct CollisionOptions {
  double clearance = 1e-3;     ///< distance that is kept, m, above 0
  bool self_collision = true;  ///< whether links must keep it from each other
  /// Pairs of links and obstacles that may touch, besides the scene's own pairs.
  std::vector<NamedPair> allowed_pairs = {};
  /// Bound of the search for pairs of links that never come closer than the clearance, see
  /// CollisionModel. A unit of work takes some microseconds. Default: 10,000 units.
  Budget budget = {.max_work = 10'000};
};

/// Two bodies of a model, of which the first belongs to the arm, at a distance between two bounds.
struct BodyDistance {
  NamedPair names;  ///< names of the two bodies
  /// Index from 0 of the nearest point, if the second body is an obstacle's point cloud.
  std::optional<std::size_t> point = std::nullopt;
  /// At most the distance, m, rounded down. If negative, the bodies may touch, and a translation
  /// along `normal` by this distance would separate them.
  double lower = 0;
  double upper = 0;                     ///< at least the distance, m, rounded up
  double clearance = 0;                 ///< distance that must be kept, m
  Vector3 on_first = Vector3::Zero();   ///< a point of the first body, in the world, m
  Vector3 on_second = Vector3::Zero();  ///< a point of the second body, in the world, m
  Vector3 normal = Vector3::UnitX();    ///< unit vector from the first body to the second
  /// Change of the distance for each coordinate, m per rad or m (n,); without meaning where the
  /// nearest points jump.
  Eigen::VectorXd gradient = {};
};

/// Returns the names of the two bodies, "hand and table"; the nearest point of a cloud has its
/// index: "hand and scan[12]".
std::string names_text(const BodyDistance& pair);

/// An arm with the shapes of its links in a scene, prepared for questions about distances.
/// Immutable.
///
/// All pairs of a link and an obstacle, and of two links, count, except bodies that never move
/// relative to each other, links that share a joint, allowed pairs, and two links that are proved
/// to keep their clearance at all configurations within the position limits. The latter count where
/// a configuration or a motion exceeds the limits.
class CollisionModel {
 public:
  /// Throws Error for a shape, a cloud or a clearance that is not valid (check_shape(),
  /// check_cloud(), check_clearance()), a half-space that a link carries, an obstacle without
  /// shapes and cloud, a name that is empty or given twice, a link that the arm does not have, and
  /// an allowed pair with an unknown name.
  CollisionModel(const Arm& arm, const std::vector<LinkShapes>& links, const Scene& scene = {},
                 const CollisionOptions& options = {});
  CollisionModel(CollisionModel&&) noexcept;
  CollisionModel& operator=(CollisionModel&&) noexcept;
  ~CollisionModel();

  const Arm& arm() const;
  /// Returns the bodies of the arm, as they were given.
  const std::vector<LinkShapes>& links() const;
  /// Returns the obstacles with the pairs that may touch, as they were given.
  const Scene& scene() const;
  /// Returns the distance that is kept, m, except from obstacles with their own.
  double clearance() const;
  /// Returns the number of pairs that count: pairs of a link's shape and an obstacle's shape or
  /// point, or of two links' shapes.
  std::size_t pair_count() const;
  /// Returns the number of pairs of two links' shapes that count only outside the position limits.
  std::size_t apart_count() const;
  /// Returns the pairs of bodies of the arm that share a joint and, for this reason, do not count.
  std::vector<NamedPair> neighbour_pairs() const;

  const internal::CollisionBodies& bodies() const { return *bodies_; }

 private:
  friend CollisionModel with_mount(const CollisionModel& model, const Pose& world_T_mount);
  friend CollisionModel internal::with_carried(const CollisionModel& model,
                                               const std::vector<LinkShapes>& parts,
                                               const Scene& scene, const CollisionOptions& options);
  explicit CollisionModel(std::unique_ptr<const internal::CollisionBodies> bodies);

  std::unique_ptr<const internal::CollisionBodies> bodies_;
};

/// Returns the model of the arm mounted in the world, see with_mount() of an arm; obstacles stay
/// where they are. It is prepared quickly, because `model` knows the pairs of links that never
/// come close; only the obstacles, with the points of clouds, are copied and sorted again.
CollisionModel with_mount(const CollisionModel& model, const Pose& world_T_mount);

/// Returns a fingerprint of what a model checks, 16 hexadecimal digits: the shapes of links and
/// obstacles with their poses, clearances and the pairs that count, but neither names nor the arm.
/// It is the same in each run. Models that differ have different ones, except by chance.
std::string digest(const CollisionModel& model);

/// Returns the pair with the least distance beyond its clearance at a configuration. Throws Error
/// when q does not fit the arm, and for a model without pairs.
BodyDistance nearest_pair(const CollisionModel& model, const ConfigurationRef& q);

/// Returns the smallest distance beyond its clearance over all pairs at a configuration, m, rounded
/// down, or `most` if that is smaller; negative if the configuration is blocked. Throws Error when
/// q does not fit the arm, and for `most` below 0.
double spare_clearance(const CollisionModel& model, const ConfigurationRef& q,
                       double most = Limits::none);

/// Returns all pairs that may be closer than their clearance, the deepest first.
std::vector<BodyDistance> pairs_too_close(const CollisionModel& model, const ConfigurationRef& q);

/// Returns why a configuration is blocked; no reason if each pair is proved to keep its clearance
/// there. The reason is bodies_collide or bodies_too_close for a pair that is proved to be closer,
/// the deepest of those; clearance_not_decided if no pair is, but the bounds of one enclose its
/// clearance. For InverseOptions::blocked_by.
Reason blocked_by(const CollisionModel& model, const ConfigurationRef& q);

/// Returns why the arm cannot stand at its mount; no reason if link 0, whose pairs with obstacles
/// do not count anywhere else, is proved to keep its clearance from each of them. Allowed pairs do
/// not count, nor does what link 0 stands on: a shape or a point that ends, along the z axis of
/// link 0, at most max_standing_overlap above the lowest point of its shapes. Reasons as of
/// blocked_by().
Reason base_blocked_by(const CollisionModel& model);

/// Overlap, m, of link 0 with what it stands on. Shapes contain their links: the built-in ones
/// exceed them by up to 15 mm.
constexpr double max_standing_overlap = 0.02;

/// Returns the names of the obstacles that are farther from the arm than ten times its reach, or
/// whose shapes all have a radius of more than a hundred times, as numbers in millimetres put them.
/// Requires valid shapes.
std::vector<std::string> far_obstacles(const Arm& arm, const Scene& scene);

}  // namespace beeline

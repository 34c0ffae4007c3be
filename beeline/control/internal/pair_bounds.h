#pragma once

#include <cstdint>
#include <vector>

#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {

/// A pair of bodies of a CollisionModel, the first of which the arm carries.
struct BodyPair {
  std::uint32_t first = 0;   ///< index of the link's body
  std::uint32_t second = 0;  ///< index of the obstacle's body, or of the earlier link's
  bool is_obstacle = false;
  bool is_apart = false;  ///< whether it counts only outside the position limits
  double clearance = 0;   ///< distance that must be kept, m
};

/// The largest displacements of a body's points by a motion of the joints.
class BodyMotions {
 public:
  explicit BodyMotions(const CollisionBodies& bodies);

  /// Continues as a new object does.
  void reset();

  /// Sets a motion of the joints from q, rad or m.
  void set(const ConfigurationRef& q, const Eigen::VectorXd& motion);

  /// Bounds the displacement of a link's body relative to frame `from`, m.
  double of(std::uint32_t body, std::size_t from) const;

  const JointReach& reach(std::uint32_t body) const { return reaches_[body]; }

 private:
  void cover(const ConfigurationRef& q, const Eigen::VectorXd& motion);

  const CollisionBodies* bodies_;
  bool slides_ = false;                            ///< whether a reach depends on the configuration
  std::vector<JointReach> reaches_;                ///< of each link's body
  Eigen::VectorXd lower_, upper_;                  ///< coordinates for which the reaches hold
  std::vector<double> steps_angle_, steps_slide_;  ///< |rotation| and |translation| of each joint
};

/// Lower bounds of the distances of all pairs of a model in a control loop. A bound that was
/// computed at one configuration decreases by the displacements of the bodies, so the distances of
/// pairs that are far apart are computed rarely. Does not allocate after construction.
class PairBounds {
 public:
  explicit PairBounds(const CollisionBodies& bodies);

  /// Forgets all bounds, as a new object does.
  void reset();

  /// Moves from the last configuration to q.
  void move_to(const ConfigurationRef& q);

  std::size_t size() const { return pairs_.size(); }
  const BodyPair& pair(std::size_t i) const { return pairs_[i]; }

  /// At most the distance of the pair beyond its clearance, m.
  double excess(std::size_t i) const { return excess_[i]; }
  void set_excess(std::size_t i, double excess) { excess_[i] = excess; }

  /// The pairs of a link's body with obstacles, from `begin` to before `end`.
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  const Range& obstacles_of(std::uint32_t body) const { return of_body_[body]; }
  std::size_t first_self_pair() const { return first_self_pair_; }

  /// Returns the least excess of the range.
  double least_excess(const Range& range) const;

  BodyMotions& motions() { return motions_; }
  const BodyMotions& motions() const { return motions_; }

 private:
  void lower(std::size_t i, double displacement);

  std::vector<BodyPair> pairs_;  ///< with obstacles, in the order of the bodies, then of links
  std::vector<double> excess_;
  std::vector<Range> of_body_;
  std::size_t first_self_pair_ = 0;
  const CollisionBodies* bodies_;
  BodyMotions motions_;
  bool has_moved_ = false;
  Configuration at_;  ///< the last configuration, once it has moved
  Eigen::VectorXd moved_;
};

}  // namespace beeline::internal

#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {

/// A pair of bodies of a CollisionModel, the first of which the arm carries.
struct BodyPair {
  std::uint32_t first = 0;   ///< index of the link's body
  std::uint32_t second = 0;  ///< index of the obstacle's body, or of the earlier link's
  bool is_obstacle = false;
  std::uint32_t group = 0;  ///< index of its PairGroup
  double clearance = 0;     ///< distance that must be kept, m
};

/// The pairs of one body of a link with bodies that one frame carries, whose relative motion has
/// the same bound.
struct PairGroup {
  std::uint32_t first = 0;         ///< index of the link's body
  std::size_t from = 0;            ///< the frame; 0 for obstacles
  bool is_apart = false;           ///< whether they count only outside the position limits
  std::size_t begin = 0, end = 0;  ///< the pairs, from `begin` to before `end`
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
  double of(std::uint32_t body, std::size_t from) const { return displacements_[body][from]; }

  const JointReach& reach(std::uint32_t body) const { return reaches_[body]; }

 private:
  void cover(const ConfigurationRef& q, const Eigen::VectorXd& motion);

  const CollisionBodies* bodies_;
  bool slides_ = false;              ///< whether a reach depends on the configuration
  std::vector<JointReach> reaches_;  ///< of each link's body
  Eigen::VectorXd lower_, upper_;    ///< coordinates for which the reaches hold
  std::vector<std::vector<double>> displacements_;  ///< of() of each body and frame before it
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
  double excess(std::size_t i) const {
    return lowered(levels_[i], states_[pairs_[i].group].travelled);
  }
  void set_excess(std::size_t i, double excess);

  /// The groups of pairs: of each body with the obstacles, then of pairs of links.
  const std::vector<PairGroup>& groups() const { return groups_; }
  /// Returns the least excess of a group.
  double least_excess(std::size_t group) {
    if (states_[group].is_stale) find_least(group);
    return lowered(states_[group].least, states_[group].travelled);
  }

  BodyMotions& motions() { return motions_; }
  const BodyMotions& motions() const { return motions_; }

 private:
  /// How far the bodies of a group have moved, and its least level.
  struct GroupState {
    double travelled = 0;  ///< m, since the levels of the group were last lowered
    double least = 0;
    bool is_stale = true;  ///< whether `least` has to be computed again
  };

  /// Relative bound of the rounding of lowered(), itself included.
  static constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();

  /// The level less what was travelled, and less the rounding of both.
  static double lowered(double level, double travelled) {
    return level - travelled - rounding * (std::abs(level) + travelled);
  }

  void add(const BodyPair& pair, std::size_t from, bool is_apart);
  void lower_levels(std::size_t group);
  void find_least(std::size_t group);

  std::vector<BodyPair> pairs_;  ///< by their groups
  /// Of each pair: its excess plus the distance that its group has travelled, rounded down.
  std::vector<double> levels_;
  std::vector<PairGroup> groups_;
  std::vector<GroupState> states_;  ///< of each group
  BodyMotions motions_;
  bool has_moved_ = false;
  Configuration at_;  ///< the last configuration, once it has moved
  Eigen::VectorXd moved_;
};

}  // namespace beeline::internal

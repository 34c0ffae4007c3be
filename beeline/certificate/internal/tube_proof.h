#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/collision/internal/box_gaps.h>
#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/collision/internal/moving_capsule.h>

namespace beeline::internal {

/// A pair that is not proved yet: a body of the arm with another one of it or with an obstacle, a
/// group of bodies with all obstacles in a node of the tree, or a pair of two groups.
struct OpenPair {
  enum class With : std::uint8_t { link, obstacle, node, group };
  With with = With::node;
  std::uint32_t body = 0;        ///< index in groups; of a body it is the index in link_bodies
  std::uint32_t other = 0;       ///< index in groups, in obstacle_bodies or of the node
  std::uint32_t group_pair = 0;  ///< index in group_pairs
  /// The direction that was tried last, in the axes of the frame that carries the other body; zero:
  /// none.
  Vector3 direction = Vector3::Zero();

  bool is_of_bodies() const { return with == With::link || with == With::obstacle; }
};

/// A pair of bodies that must keep another distance than its clearance.
struct ReleasedPair {
  OpenPair pair;
  /// Signed distance, m; below 0 the depth of the contact.
  double distance = 0;
};

/// Proves that pairs of bodies keep their clearance over a joint tube.
class TubeProof {
 public:
  /// All tubes are parts of the motion that the tube `whole` contains. `beyond` is added to the
  /// clearances.
  TubeProof(const CollisionBodies& bodies, const TubeValues& whole, double beyond);

  /// Sets the pairs that must keep another distance, in the order of comes_before(). The argument
  /// outlives the proofs.
  void release(std::span<const ReleasedPair> pairs) { released_ = pairs; }

  /// An order of pairs of bodies.
  static bool comes_before(const OpenPair& a, const OpenPair& b);

  /// Begins the tests of a tube.
  void place(const JointTube& tube);

  /// The bound of the distance of a pair over the tube, from some direction: a proof if it is at
  /// least `required`.
  struct Bound {
    double distance = 0, required = 0;
    bool proves() const { return distance >= required; }
  };
  /// Keeps the best direction in the pair. displacement(), rounding() and is_coarse_group_pair()
  /// require that bound() or distance() was called for the pair in this tube.
  Bound bound(OpenPair& pair);

  /// The distance that the bodies of a pair must keep, m; of a node the largest of its obstacles.
  double clearance(const OpenPair& pair) const;

  /// The distance that is to be proved for a pair, m: its clearance and `beyond`, unless it is
  /// released.
  double required(const OpenPair& pair) const;

  /// The motion, m, up to which a pair is divided that the resolution, a fraction of the clearance,
  /// does not decide. A released pair begins at the distance that it must keep.
  double smallest_motion(const OpenPair& pair, double resolution) const;

  /// A bound of the motion of the pair relative to each other from the middle of the tube, m.
  double displacement(const OpenPair& pair) const;

  /// The part of the bounds of a pair that is for rounding, m.
  double rounding(const OpenPair& pair) const;

  /// Whether a pair of groups is to be divided: one of them is larger than the motion.
  bool is_coarse_group_pair(const OpenPair& pair) const;

  /// Appends the pairs of which a pair of groups consists.
  void divide_group_pair(const OpenPair& pair, std::vector<OpenPair>& into) const;

  /// A search of the tree for the obstacles that a group is not proved to keep its clearance from.
  struct TreeSearch {
    std::vector<std::uint32_t>& nodes;  ///< to be tested
    std::vector<OpenPair>& open;        ///< pairs with nodes that are not proved are appended
    std::vector<OpenPair>& obstacles;   ///< pairs with obstacles, to be tested, are appended
    bool all = false;                   ///< whether all nodes are divided, or those that are coarse
    double least_distance = std::numeric_limits<double>::infinity();  ///< of what is proved
  };
  /// Tests a group with the nodes of the search and with the nodes below.
  void search_tree(std::uint32_t group, TreeSearch& search);

  /// Whether a pair, at the middle of the tube, is closer than what is to be proved. A released one
  /// is closer than its clearance and, as far as its lower bound says, than it must keep.
  bool is_too_close(const OpenPair& pair, const BodyDistance& found) const;

  /// Returns the pair at the middle of the tube.
  BodyDistance distance(const OpenPair& pair);

 private:
  /// A group over the tube. The motion is relative to the base.
  struct Placed {
    std::size_t tube = 0;  ///< number of the tube; the values are of it
    MovingCapsule capsule;
    double rounding = 0;  ///< ChainMotion::rounding()
  };

  struct Scratch {
    std::optional<ChainMotion> motion;
    std::vector<JointReach> reach;     ///< of each of the groups that has none itself, at its index
    Configuration lower, upper;        ///< bounds of the coordinates, for these
    std::vector<Placed> placed;        ///< of each of the groups
    std::vector<std::uint32_t> split;  ///< nodes that a group's bodies are to be tested with

    bool is_small() const { return placed.size() <= 1000 && split.capacity() <= 100'000; }
  };

  void set_reach(const TubeValues& whole);
  /// Computes the values of a group for the present tube. Most tubes are tested for a few.
  void place_group(std::uint32_t i);
  void place_both(const OpenPair& pair);
  const JointReach& reach(std::uint32_t i) const;
  bool is_of_links(const OpenPair& pair) const;
  const ReleasedPair* released(const OpenPair& pair) const;  ///< null: it is not

  /// Whether a pair of a group and a node is to be divided, likewise.
  bool is_coarse_node(std::uint32_t group, std::uint32_t index) const;
  double size_of(std::uint32_t group) const;  ///< 0 for a body: it cannot be divided
  void search_nodes(std::uint32_t group, TreeSearch& search);
  void divide_node(const OpenPair& pair, TreeSearch& search);

  // Bounds from the groups alone, along one direction.
  double gap_of_groups(const OpenPair& pair) const;
  double gap_to_obstacle(const OpenPair& pair) const;
  bool is_exact(const OpenPair& pair) const;
  bool may_improve(const OpenPair& pair, const Bound& found) const;
  void improve(OpenPair& pair, Bound& found) const;

  /// A quarter of the 1e-9 m that a released pair may come closer.
  static constexpr double smallest_released_motion = 2.5e-10;

  const CollisionBodies& bodies_;
  double beyond_;
  std::span<const ReleasedPair> released_ = {};
  std::size_t tube_ = 0;  ///< number of tubes so far
  ThreadScratch<Scratch> scratch_;
  ChainMotion& motion_;
  std::vector<Placed>& placed_;
};

}  // namespace beeline::internal

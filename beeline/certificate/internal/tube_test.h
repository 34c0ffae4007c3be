#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/collision/internal/box_gaps.h>
#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/collision/internal/moving_capsule.h>

namespace beeline::internal {

/// A pair that is not proved yet: a body of the arm with another one of it or with an obstacle, a
/// cover of bodies with all obstacles in a node of the tree, or the pairs of two covers.
struct OpenPair {
  enum class With : std::uint8_t { link, obstacle, node, group };
  With with = With::node;
  std::uint32_t body = 0;   ///< index in covers; of a body it is the index in link_bodies
  std::uint32_t other = 0;  ///< index in covers, in obstacle_bodies or of the node
  std::uint32_t group = 0;  ///< index in self_groups
  /// The direction that was tried last, in the axes of the frame that carries the other body; zero:
  /// none.
  Vector3 direction = Vector3::Zero();

  bool is_of_bodies() const { return with == With::link || with == With::obstacle; }
};

/// Tests whether pairs of bodies keep their clearance over a joint tube.
class TubeTest {
 public:
  /// Coordinates of joints that slide are between `lower` and `upper` in all tubes. `beyond` is
  /// added to the clearances.
  TubeTest(const CollisionBodies& bodies, const Configuration& lower, const Configuration& upper,
           double beyond);

  /// Begins the tests of a tube.
  void place(const JointTube& tube);

  /// The bound of the distance of a pair over the tube, from some direction: a proof if it is at
  /// least `required`.
  struct Bound {
    double distance = 0, required = 0;
    bool proves() const { return distance >= required; }
  };
  /// Keeps the best direction in the pair. displacement(), rounding() and is_coarse_group() require
  /// that bound() or distance() was called for the pair in this tube.
  Bound bound(OpenPair& pair);

  /// The distance that the bodies of a pair must keep, m; of a node the largest of its obstacles.
  double clearance(const OpenPair& pair) const;

  /// A bound of the motion of the pair relative to each other from the middle of the tube, m.
  double displacement(const OpenPair& pair) const;

  /// The part of the bounds of a pair that is for rounding, m.
  double rounding(const OpenPair& pair) const;

  /// Whether a pair of covers is to be divided: one of them is larger than the motion.
  bool is_coarse_group(const OpenPair& pair) const;

  /// Appends the pairs of which a pair of covers consists.
  void divide_group(const OpenPair& pair, std::vector<OpenPair>& into) const;

  /// A search of the tree for the obstacles that a cover is not proved to keep its clearance from.
  struct TreeSearch {
    bool all = false;                  ///< whether all nodes are divided, or those that are coarse
    std::vector<std::uint32_t> nodes;  ///< to be tested
    std::vector<OpenPair>& open;       ///< pairs with nodes that are not proved are appended
    std::vector<OpenPair>& obstacles;  ///< pairs with obstacles, to be tested, are appended
    double least_distance = std::numeric_limits<double>::infinity();  ///< of what is proved
  };
  /// Tests a cover with the nodes of the search and with the nodes below.
  void search_tree(std::uint32_t cover, TreeSearch& search);

  /// Returns the pair at the middle of the tube.
  BodyDistance distance(const OpenPair& pair);

 private:
  /// A cover over the tube. The motion is relative to the base.
  struct Placed {
    std::size_t tube = 0;  ///< number of the tube; the values are of it
    MovingCapsule capsule;
    double rounding = 0;  ///< ChainMotion::rounding()
  };

  /// Computes the values of a cover for the present tube. Most tubes are tested for a few.
  void place_cover(std::uint32_t i);
  void place_both(const OpenPair& pair);
  const JointReach& reach(std::uint32_t i) const;
  bool is_of_links(const OpenPair& pair) const;

  /// Whether a pair of a cover and a node is to be divided, likewise.
  bool is_coarse_node(std::uint32_t cover, std::uint32_t index) const;
  double size_of(std::uint32_t cover) const;  ///< 0 for a body: it cannot be divided
  void search_nodes(std::uint32_t cover, TreeSearch& search);
  void divide_node(const OpenPair& pair, TreeSearch& search);

  // Bounds from the covers alone, along one direction.
  double gap_of_covers(const OpenPair& pair) const;
  double gap_to_obstacle(const OpenPair& pair) const;
  bool is_exact(const OpenPair& pair) const;
  void improve(OpenPair& pair, Bound& found) const;

  const CollisionBodies& bodies_;
  double beyond_;
  ChainMotion motion_;
  std::size_t tube_ = 0;              ///< number of tubes so far
  std::vector<JointReach> reach_;     ///< of each of the covers that has none itself, at its index
  std::vector<Placed> placed_;        ///< of each of the covers
  std::vector<std::uint32_t> split_;  ///< nodes that the bodies of a cover are to be tested with
};

}  // namespace beeline::internal

#pragma once

#include <cstdint>
#include <vector>

#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {

/// A pair that is not proved yet: a body of the arm with another one of it, with an obstacle, or
/// with all obstacles in a node of the tree.
struct OpenPair {
  enum class With : std::uint8_t { link, obstacle, node };
  With with = With::node;
  std::uint32_t body = 0;   ///< index in link_bodies
  std::uint32_t other = 0;  ///< index in link_bodies, in obstacle_bodies or of the node
  /// The direction that was tried last, in the axes of the frame that carries the other body; zero:
  /// none.
  Vector3 direction = Vector3::Zero();
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
  /// Keeps the best direction in the pair. displacement(), rounding() and is_coarse() require that
  /// bound() or distance() was called for the pair in this tube.
  Bound bound(OpenPair& pair);

  /// The distance that the bodies of a pair must keep, m; of a node the largest of its obstacles.
  double clearance(const OpenPair& pair) const;

  /// A bound of the motion of the pair relative to each other from the middle of the tube, m.
  double displacement(const OpenPair& pair) const;

  /// The part of the bounds of a pair that is for rounding, m.
  double rounding(const OpenPair& pair) const;

  /// Whether the pair is of a node of the tree whose children are to be tested apart: the node is
  /// a leaf, or larger than the motion.
  bool is_coarse(const OpenPair& pair) const;

  /// Returns the pair at the middle of the tube.
  BodyDistance distance(const OpenPair& pair);

 private:
  /// A body of the arm over the tube, in the world's axes.
  struct Placed {
    std::size_t tube = 0;              ///< number of the tube; the values are of it
    Vector3 centre = Vector3::Zero();  ///< of its sphere at the middle
    double displacement = 0;           ///< ChainMotion::displacement() relative to the base
    double rounding = 0;               ///< ChainMotion::rounding()
    double remainder = -1;             ///< ChainMotion::remainder() to the base; -1: not yet
  };

  /// Computes the values of a body for the present tube. Most tubes are tested for a few bodies.
  void place_body(std::uint32_t i);
  void place_bodies(const OpenPair& pair);
  const JointReach& reach(std::uint32_t i) const;
  double remainder(std::uint32_t i, std::size_t j);  ///< relative to frame j, m

  Bound bound_to_node(OpenPair& pair);
  Bound bound_to_body(OpenPair& pair);

  const CollisionBodies& bodies_;
  double beyond_;
  ChainMotion motion_;
  std::size_t tube_ = 0;           ///< number of tubes so far
  std::vector<JointReach> reach_;  ///< of each of link_bodies that has none itself, at its index
  std::vector<Placed> placed_;     ///< of each of link_bodies
};

}  // namespace beeline::internal

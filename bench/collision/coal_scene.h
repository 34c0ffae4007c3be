#pragma once

#include <memory>

#include <beeline/collision/collision_model.h>

namespace beeline::bench {

/// Whether coal was found when this program was built; without it the other answers are empty.
bool has_coal();

/// A distance that coal computes, of the two bodies that are nearest to each other.
struct CoalDistance {
  double value = 0;  ///< m, below 0 for bodies that overlap
  NamedPair names = {};
};

/// An arm in a scene, as coal checks it: the same bodies and pairs as in a CollisionModel of these
/// parts, including the pairs of the arm that the model excludes by a proof. Pairs whose bounding
/// boxes are far apart are skipped.
class CoalScene {
 public:
  CoalScene(const Arm& arm, const std::vector<LinkShapes>& links, const Scene& scene);
  ~CoalScene();

  /// Whether two bodies are closer than `margin` (coal's security margin) at a configuration.
  bool collides(const Configuration& q, double margin);

  /// The least distance over all pairs at a configuration.
  CoalDistance least_distance(const Configuration& q);

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
};

/// The distance of two shapes that coal computes.
double coal_distance(const Shape& first, const Shape& second);

}  // namespace beeline::bench

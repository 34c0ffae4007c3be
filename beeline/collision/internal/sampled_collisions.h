#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <beeline/collision/internal/collision_bodies.h>

namespace beeline::internal {

/// Looks for configurations that do not keep the clearance, eight at a time. Nothing here is
/// proved, and the pairs that count only outside the position limits are left out: a search asks
/// here what is worth a proof.
class SampledCollisions {
 public:
  static constexpr int at_once = 8;

  /// Refers to the bodies, which outlive the object.
  explicit SampledCollisions(const CollisionBodies& bodies);

  /// Returns the index of the first of eight configurations that is blocked; `at_once` if none is.
  /// q has a row of eight values for each coordinate.
  int first_blocked(const double* q);

  /// A pair that the capsules around its bodies do not decide.
  struct OpenPair {
    std::uint32_t body = 0;       ///< index in link_bodies
    std::uint32_t other = 0;      ///< index in link_bodies or obstacle_bodies
    bool is_of_links = false;     ///< which of them
    unsigned configurations = 0;  ///< bit k: of configuration k
  };

  /// What the lanes find.
  struct Found {
    unsigned open = 0;  ///< bit k: no configuration up to k is blocked for sure
    std::vector<OpenPair> pairs;
    std::vector<std::array<double, 12 * at_once>> frames;  ///< rows: axes x, y, z and the origin
    std::vector<std::uint32_t> nodes;                      ///< of the tree, to be tested
  };

 private:
  bool is_blocked(const OpenPair& pair, std::size_t k) const;
  ConvexBody placed(std::uint32_t body, std::size_t k) const;

  const CollisionBodies& bodies_;
  Found found_;
};

}  // namespace beeline::internal

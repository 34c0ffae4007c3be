#pragma once

#include <functional>
#include <unordered_map>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Finds whether a configuration is the same posture as one of many, without a comparison with all
/// of them: only postures with a similar first coordinate are compared. A query takes constant time
/// for any number of postures that are spread over the range of that coordinate.
class PostureIndex {
 public:
  /// Returns known configuration i.
  using Known = std::function<const Configuration&(std::size_t i)>;

  /// Whether q is the same_posture() as one of the first `count` known configurations, which must
  /// begin with the configurations of earlier calls. A smaller `count` than in the last call starts
  /// anew.
  bool contains(const Arm& arm, std::size_t count, const Known& known, const Configuration& q);

 private:
  /// Indices of postures by the cell of their first coordinate.
  std::unordered_multimap<double, std::size_t> cells_;
  std::size_t indexed_ = 0;
};

}  // namespace beeline::internal

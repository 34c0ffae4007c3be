#pragma once

#include <unordered_map>
#include <vector>

#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

/// Tells whether a configuration is the same posture as one of many, without a comparison with all
/// of them: only those whose first coordinate is near are compared. For any number of postures that
/// are spread over the range of that coordinate, a question takes constant time.
class PostureIndex {
 public:
  /// Whether q is the same_posture() as one of the first `count` configurations, which must begin
  /// with those of earlier calls. `count` below that of the last call: begins anew.
  bool contains(const Arm& arm, const std::vector<Configuration>& known, std::size_t count,
                const Configuration& q);

 private:
  /// By cell of the first coordinate, as a whole number of cells.
  std::unordered_multimap<double, std::size_t> cells_;
  std::size_t indexed_ = 0;
};

}  // namespace beeline::internal

#pragma once

#include <vector>

#include <beeline/planning/internal/blend_refusals.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline::internal {

/// Returns the moves of a part whose blends between two lines may be why motion_along() refuses its
/// route: the blend where the branch ends; otherwise the blends where the motion is not proved
/// or leaves the limits, or those next to the lines where it is so; all blends if it has no times;
/// none if it needs fewer samples or another rate.
std::vector<std::size_t> refused_blends(const Arm& arm, const ProgramPart& part,
                                        const PathMotion& refused, const Deviation& tolerance);

/// The sizes of the blends between two lines in the search for the paths of a program.
class LineBlends {
 public:
  /// Keeps the blends that may be why the path of parts[p] is refused.
  void refuse(std::size_t p, std::vector<std::size_t> moves);

  /// Forgets them: a path is possible.
  void accept() { moves_.clear(); }

  /// Makes these blends smaller, or stops. Returns whether there are any, and the search for this
  /// part has not ended.
  bool make_smaller(const Program& program, double tool_speed, std::vector<ProgramPart>& parts);

 private:
  /// What was refused in a part.
  struct Part {
    BlendRefusals refusals{};
    std::vector<int> refused = {};  ///< how often the blend of each move was
  };

  std::vector<Part> parts_ = {};
  std::size_t part_ = 0;  ///< of the last refusal
  std::vector<std::size_t> moves_ = {};
};

}  // namespace beeline::internal

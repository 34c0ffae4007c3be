#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/section_joint_path.h>
#include <beeline/timing/internal/timed_section.h>

namespace beeline::internal {

/// A motion from one waypoint of a program to the next that may be one in blends: a joint motion,
/// or a section of a tool path.
struct MovePiece {
  std::size_t part = 0;
  std::size_t last_move = 0;  ///< move of the program with which it ends
  JointPath path = {};        ///< parameter from 0; empty for a motion at rest
  /// Of a tool path: what the joint path follows, and its first and last segment.
  std::shared_ptr<const SectionJointPath> tool = nullptr;
  std::size_t first_segment = 0, last_segment = 0;
  ToolSpeeds speeds = {};  ///< along the joint path

  double length() const { return path.size() == 0 ? 0 : path.s.back(); }
  /// The point of the joint path with parameter s.
  PathPoint at(double s) const;
  /// The length of the joint path along its last segment, or along its first one.
  double length_beside_end() const;
  double length_beside_begin() const;
};

/// The straight joint motion of a part.
MovePiece joint_piece(const ProgramPart& part, std::size_t index, const Configuration& from,
                      const Configuration& to, double tool_speed);

/// The sections of a path, whose motion is sampled without a rate. Empty if its samples do not have
/// the ends of its segments. The request must outlive them.
std::vector<MovePiece> path_pieces(const MotionRequest& request, const ProgramPart& part,
                                   std::size_t index, const PathMotion& motion,
                                   BudgetMeter& budget);

}  // namespace beeline::internal

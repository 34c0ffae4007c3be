#pragma once

#include <optional>
#include <vector>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/carried_parts.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline::internal {

/// The arm in its scene while a program is planned, with the parts that the tool carries.
class CurrentScene {
 public:
  /// Before the first move. Both arguments must outlive the object; the model must have the parts.
  CurrentScene(const CollisionModel& model, const Program& program);

  /// Continues after this number of moves, at rest at a configuration.
  void arrive(std::size_t moves, const ConfigurationRef& q);

  /// The arm with the parts that it carries, among the other obstacles.
  const CollisionModel& model();

  /// blocked_by() of model(), to which the result refers: not valid after arrive().
  decltype(InverseOptions::blocked_by) blocked();

  /// Erases the configurations that are blocked; returns why the first of them is.
  Reason erase_blocked(std::vector<Configuration>& configurations);

  /// Why the motion of the next part is blocked, up to where a part is next attached or detached;
  /// no reason if it is proved to keep the clearance.
  Reason blocked_ahead(const ProgramPart& part, const PathMotion& motion, const Budget& budget);

 private:
  const CollisionModel& model_;
  const Program& program_;
  CarriedParts parts_;
  bool is_changed_ = false;  ///< whether a part was attached or detached
  std::optional<CollisionModel> changed_ = std::nullopt;  ///< since then, once it is needed
};

}  // namespace beeline::internal

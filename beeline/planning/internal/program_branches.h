#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/current_scene.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline::internal {

/// Finds the configurations at which the moves of a program end, and the motions along its paths.
/// A function that finds none fails with the move and the reason, which it sets in the motion.
class ProgramBranches {
 public:
  /// Keeps references to the arm, the program and the model.
  ProgramBranches(const Arm& arm, const Program& program, const PathMotionOptions& options,
                  const CollisionModel* model);

 protected:
  /// Fails in a move. The reason contains the name of the move or, if given, the name of its part.
  bool fail(std::size_t move, MotionStatus status, Reason reason, const std::string& name = {});

  /// Forgets why the branches before this one are not possible.
  bool succeed();

  bool fail_ended(std::size_t move);

  /// Sets q to the configuration with the tool at the pose that is reached soonest.
  bool configuration_at(std::size_t move, const Pose& pose, const Configuration& from,
                        std::optional<Configuration>& q);

  /// Sets q to the solution of a search with all means, or fails with the reason why there is none.
  bool solution_at(std::size_t move, const Pose& pose, const Configuration& from,
                   std::optional<Configuration>& q);

  /// Plans the path of a part.
  bool follow(std::size_t p, const std::optional<Configuration>& q,
              std::optional<PathMotion>& ahead);

  /// Plans the path of a part, which must keep the clearance.
  bool follow_free(std::size_t p, const Configuration& q, std::optional<PathMotion>& ahead);

  /// Whether a branch of the path of part p begins at a configuration.
  bool has_branch(std::size_t p, const Configuration& q);

  /// Finds the configuration reached first of those from which the path of part p is possible.
  bool choose_branch(std::size_t p, const Configuration& from, std::optional<Configuration>& q,
                     std::optional<PathMotion>& ahead);

  bool path_follows(std::size_t p) const { return p + 1 < parts_.size() && !parts_[p + 1].joint; }

  const Arm& arm_;
  const Program& program_;
  BudgetMeter budget_;
  PathMotionOptions options_;
  ProgramMotion motion_ = {};
  std::vector<ProgramPart> parts_ = {};
  std::optional<CurrentScene> scene_ = std::nullopt;
};

}  // namespace beeline::internal

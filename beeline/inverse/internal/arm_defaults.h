#pragma once

#include <optional>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/internal/tool_volume.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/model/internal/kept.h>

/// \file
/// What inverse kinematics keeps with an arm, besides the solvers: see Kept.

namespace beeline::internal {

/// Values that a request has by default.
struct ArmDefaults {
  Bounds limits, no_limits;
  Configuration middle;            ///< the default seed
  Configuration ones;              ///< the default weights
  std::optional<ToolPlane> plane;  ///< the plane in which poses for the default task must be
  ToolVolume volume;

  using Key = OnlyKey;
  static constexpr SharedBy shared_by = SharedBy::copies;
  static ArmDefaults make(const Arm& arm, const Key&);
  std::size_t heap_bytes() const;
};

/// PieperSolver::make() of the arm and a task.
struct PieperForm {
  /// Nothing too for an arm of six joints that can move with the tool at rest from every
  /// configuration.
  std::optional<PieperSolver> solver;
  bool verified = true;   ///< whether it recovered random configurations of the arm
  double error = 0;       ///< largest error of these, m and rad; infinite if it is unknown
  std::string name = {};  ///< PieperSolver::family()

  using Key = Task;
  static constexpr SharedBy shared_by = SharedBy::limits;
  static PieperForm make(const Arm& arm, const Task& task);
  std::size_t heap_bytes() const { return name.capacity(); }
};

/// The coordinate that an arm of seven revolute joints locks for a closed form of the others.
struct RedundantJoint {
  int coordinate = 0;

  using Key = OnlyKey;
  static constexpr SharedBy shared_by = SharedBy::limits;
  static RedundantJoint make(const Arm& arm, const Key&);
  std::size_t heap_bytes() const { return 0; }
};

}  // namespace beeline::internal

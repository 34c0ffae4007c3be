#pragma once

#include <optional>
#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/multi_start.h>
#include <beeline/kinematics/internal/tool_plane.h>

namespace beeline::internal {

struct AnalyticFamily;

/// The private state of InverseSolver: the data of an arm for the stages, computed once, and their
/// buffers.
struct SolverState {
  Arm arm;
  InverseOptions options;
  Task task;
  std::optional<ToolPlane> plane;  ///< the plane in which poses must be, if any
  Bounds bounds;                   ///< the joint limits, or none if they are ignored
  Configuration middle;            ///< the default seed
  Configuration weights;           ///< options.weights, or ones
  /// The family of closed forms for the arm and the task, or null.
  const AnalyticFamily* family = nullptr;
  /// A family that is tried if the numerical stage fails, or null.
  const AnalyticFamily* fallback = nullptr;
  bool fallback_prepared = false;  ///< whether fallback->applies() was called
  std::optional<PieperSolver> pieper = std::nullopt;
  bool pieper_verified = true;  ///< whether it recovered random configurations of the arm
  std::optional<RaghavanRothSolver> raghavan_roth = std::nullopt;
  const RaghavanRothSolver* similar = nullptr;  ///< another arm's solver; only set during selection
  /// The coordinate that is locked at the values of a grid, the values (ascending, empty until the
  /// first request), and the solvers of the remaining joints, one for each value.
  int grid_coordinate = 0;
  std::vector<double> grid_values = {};
  std::vector<SolverState> grid_solvers = {};
  std::optional<PreparedSearch> within_limits = std::nullopt;
  std::optional<PreparedSearch> without_limits = std::nullopt;
  /// The coordinate of a longer arm that is locked in this one.
  std::optional<int> removed_coordinate = std::nullopt;
  // Vectors of at most one solver, because they are copied with the state.
  std::vector<SolverState> locked = {};    ///< one solver of the arm with options.lock, or none
  double locked_value = 0;                 ///< value of the locked coordinate of `locked`
  std::vector<SolverState> tolerant = {};  ///< one solver for options.pose_tolerance, or none
  std::vector<SolverState> all_solutions = {};  ///< one solver with options.all, or none
  MultiStartBuffers buffers = {};
  SearchResult search = {};
};

/// Throws Error for options that are not valid, or a closed form that the arm does not have.
/// `similar`: the solver of an arm of similar geometry, or null; takes less time.
SolverState make_solver_state(const Arm& arm, const InverseOptions& options,
                              const RaghavanRothSolver* similar = nullptr);

/// Sets state.within_limits and returns it.
const PreparedSearch& search_within_limits(SolverState& state);

/// Returns the name of the method, such as "closed form: planar".
std::string method_name(const SolverState& state);

/// Throws Error if options.lock fixes a coordinate outside its limits.
void check_lock(const SolverState& state, const ConfigurationRef& seed);

/// Max angle of a seed for the fast path. Larger angles lose too many digits (see
/// wrap_unlimited_angles()).
inline constexpr double farthest_seed = 1e3;  // radians

}  // namespace beeline::internal

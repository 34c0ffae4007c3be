#pragma once

#include <optional>
#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/multi_start.h>

namespace beeline::internal {

struct AnalyticFamily;

/// The private state of InverseSolver: what the stages need to know of an arm, computed once, and
/// their buffers.
struct SolverState {
  Arm arm;
  InverseOptions options;
  Task task;
  Bounds bounds;          ///< the joint limits, or none where they are ignored
  Configuration middle;   ///< the default seed
  Configuration weights;  ///< options.weights, or ones
  /// The family of closed forms that covers the arm and the task, or null.
  const AnalyticFamily* family = nullptr;
  /// A family that is tried where the numerical stage fails, or null.
  const AnalyticFamily* fallback = nullptr;
  bool fallback_prepared = false;  ///< whether fallback->applies() was called
  std::optional<PieperSolver> pieper = std::nullopt;
  bool pieper_verified = true;  ///< whether it recovered random configurations of the arm
  std::optional<RaghavanRothSolver> raghavan_roth = std::nullopt;
  const RaghavanRothSolver* similar = nullptr;  ///< of another arm; only while a family is selected
  /// The coordinate that is locked at the values of a grid; the values, ascending, none until the
  /// first request; and the solvers of the remaining joints, one for each value.
  int grid_coordinate = 0;
  std::vector<double> grid_values = {};
  std::vector<SolverState> grid_solvers = {};
  std::optional<PreparedSearch> within_limits = std::nullopt;
  std::optional<PreparedSearch> without_limits = std::nullopt;
  /// The coordinate of a longer arm that is locked in this one.
  std::optional<int> removed_coordinate = std::nullopt;
  std::vector<SolverState> locked = {};  ///< empty, or the solver of the arm with options.lock ...
  double locked_value = 0;               ///< ... at this value
  std::vector<SolverState> tolerant = {};  ///< empty, or the solver for options.pose_tolerance
  MultiStartBuffers buffers = {};
  SearchResult search = {};
};

/// Throws Error for options that are not valid, or a closed form that the arm does not have.
/// `similar`: the solver of an arm of similar geometry, or null; takes less time.
SolverState make_solver_state(const Arm& arm, const InverseOptions& options,
                              const RaghavanRothSolver* similar = nullptr);

/// Sets state.within_limits and returns it.
const PreparedSearch& search_within_limits(SolverState& state);

/// The name of the method, such as "closed form: planar".
std::string method_name(const SolverState& state);

/// Throws Error if options.lock fixes a coordinate outside its limits.
void check_lock(const SolverState& state, const ConfigurationRef& seed);

/// The fast path is used for seeds with angles up to this; larger angles lose too many digits (see
/// wrap_unlimited_angles()).
inline constexpr double farthest_seed = 1e3;  // radians

}  // namespace beeline::internal

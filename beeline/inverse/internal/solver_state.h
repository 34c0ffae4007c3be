#pragma once

#include <optional>

#include <beeline/internal/thread_scratch.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/inverse/internal/arm_defaults.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/multi_start.h>

namespace beeline::internal {

struct AnalyticFamily;
struct Request;

/// The memory of a request's searches, which a thread uses again.
struct SearchScratch {
  MultiStartBuffers buffers;
  SearchResult result;

  bool is_small() const { return result.solutions.capacity() <= 256; }
};

/// An arm with the options of a request, both of which outlive it, and what the stages need of
/// them. Objects that do not depend on the pose are kept by the arm, so that it costs little to
/// make one for each request.
struct SolverState {
  /// Throws Error for options that are not valid, or a closed form that the arm does not have.
  /// `similar`: the eliminations chosen for an arm of similar geometry, or null; takes less time.
  SolverState(const Arm& its_arm, const InverseOptions& its_options,
              const EliminationChoice* similar_choice = nullptr);

  const Arm& arm;
  const InverseOptions& options;
  const Kept<ArmDefaults> defaults;
  const Task task;
  const Bounds& bounds;                     ///< the joint limits, or none if they are ignored
  const Configuration& weights;             ///< options.weights, or ones
  Redundancy redundancy = Redundancy::any;  ///< options.redundancy, or `any`
  bool near_seed = false;                   ///< see Request
  /// The family of closed forms for the arm and the task, or null.
  const AnalyticFamily* family = nullptr;
  /// A family that is tried if the numerical stage fails, or null.
  const AnalyticFamily* fallback = nullptr;
  std::optional<Kept<PieperForm>> pieper = std::nullopt;
  const EliminationChoice* similar = nullptr;
  std::optional<Kept<EliminationChoice>> eliminations = std::nullopt;
  /// The coordinate that is locked at the values of a grid.
  int grid_coordinate = 0;
  /// The coordinate of a longer arm that is locked in this one.
  std::optional<int> removed_coordinate = std::nullopt;
  std::optional<Kept<NumericalProblem>> bounded_problem = std::nullopt;
  std::optional<Kept<SeedTable>> seeds[2] = {};  ///< within limits, and with limits ignored
  std::optional<ThreadScratch<SearchScratch>> scratch = std::nullopt;

  /// Sets near_seed for a request that has a seed.
  void set_near_seed();
  /// The plane in which poses must be, or null.
  const ToolPlane* plane() const;
  const PieperSolver& pieper_solver() const { return *(*pieper)->solver; }
  MultiStartBuffers& buffers();
  SearchResult& search();
  /// The number of iterations of the last search.
  int iterations() const { return scratch ? (*scratch)->result.iterations : 0; }
  void reset_search();
};

/// Whether it is proved that no configuration reaches the request's position, within limits or not.
bool is_out_of_reach(const SolverState& state, const Request& request);

/// Whether it is proved that no configuration within state.bounds reaches the request's position.
bool is_out_of_reach_within_bounds(const SolverState& state, const Request& request);

/// The problem of the searches within state.bounds.
const NumericalProblem& problem_within_bounds(SolverState& state);

/// The search for configurations within state.bounds.
Search search_within_bounds(SolverState& state);

/// The seeds for a search of the arm, for a problem with or without limits.
const SeedTable& seeds_for(SolverState& state, bool ignore_limits, const NumericalProblem& problem);

/// Returns the name of the method, such as "closed form: planar".
std::string method_name(const SolverState& state);

/// Throws Error if options.lock fixes a coordinate outside its limits.
void check_lock(const SolverState& state, const ConfigurationRef& seed);

/// Max angle of a seed for run_quick_stages(), after wrap_unlimited_angles(): larger angles lose
/// too many digits.
inline constexpr double farthest_seed = 1e3;  // radians

}  // namespace beeline::internal

#pragma once

#include <optional>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/analytic/raghavan_roth_solver.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/numerical/multi_start.h>

namespace beeline::internal {

/// PreparedSearch for one task within some bounds, and where they may start.
struct PreparedSearch {
  NumericalProblem problem;
  SeedTable seeds;
};
PreparedSearch prepared_search(const Arm& arm, const Task& task, const Bounds& bounds,
                               const InverseOptions& options);

/// What an arm is solved by, prepared as far as it was asked for.
struct InverseMethods {
  Arm arm;
  InverseOptions options;
  Task task;
  Bounds bounds;         ///< the limits, or none where these do not count
  Configuration middle;  ///< the seed where none is given
  bool planar = false;   ///< has_planar_closed_form()
  std::optional<PieperSolver> closed = std::nullopt;
  bool closed_is_sure = true;  ///< whether it found random configurations of the arm again
  bool general_six = false;    ///< six joints that turn, and no closed form of a family
  std::optional<RaghavanRothSolver> general = std::nullopt;
  std::optional<RaghavanRothSolver> second_opinion = std::nullopt;  ///< where descents find nothing
  std::optional<PreparedSearch> within = std::nullopt, anywhere = std::nullopt;
  std::optional<int> missing =
      std::nullopt;  ///< the coordinate of a longer arm that is locked in this one
  std::vector<InverseMethods> shorter = {};  ///< for options.lock: the arm that is left ...
  double shorter_value = 0;                  ///< ... with the coordinate at this value
  MultiStartBuffers buffers = {};
  SearchResult search = {};
};

/// Throws Error for options that make no sense, or a closed form that the arm does not have.
InverseMethods inverse_methods(const Arm& arm, const InverseOptions& options);

/// The general solver of six joints, if it is one for the arm. Takes milliseconds.
std::optional<RaghavanRothSolver> prepared_general(const InverseMethods& methods);

/// In words.
std::string description(const InverseMethods& methods);

/// What is known of the solutions when limits do not count.
struct UnconstrainedResult {
  bool complete = false;               ///< all there are have been looked at
  bool doubtful = false;               ///< one may have been lost to rounding
  bool continuum = false;              ///< some of them stand for infinitely many
  std::optional<Infeasibility> law;    ///< there are none, whatever the joints do
  std::optional<Configuration> least;  ///< the one that is least outside limits
};

/// Of a seed's joint that is farther from zero no turns are counted: that would cost digits.
inline constexpr double farthest_seed = 1e3;  // radians

/// Throws Error where options.lock would hold a coordinate outside its limits.
void check_lock(const InverseMethods& methods, const ConfigurationRef& seed);

/// The whole answer. Reasons take longer than solutions: they are left out where nobody asks.
InverseResult answer(InverseMethods& methods, const Pose& world_T_tool, const Configuration& seed,
                     bool with_reason);

/// The solutions in the shortest way, into the columns, where nothing about them needs a second
/// look; returns how many, or -1 where something does. Does not allocate in the ordinary course.
int solve_fast_path(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                    Eigen::Ref<Eigen::MatrixXd> solutions);

/// Puts what formulas give into result.solutions, as far as it is within limits.
UnconstrainedResult solve_closed(InverseMethods& methods, const Request& request,
                                 InverseResult& result);
UnconstrainedResult solve_general(const RaghavanRothSolver& general, const Request& request,
                                  InverseResult& result);

/// Puts what descents find into result.solutions; `unconstrained` is what is known already.
UnconstrainedResult solve_numerical(InverseMethods& methods, const Request& request,
                                    InverseResult& result, UnconstrainedResult unconstrained = {});

/// The same in the shortest way, for one solution: from the seed into the first column. Says
/// whether there is one. Does not allocate but at the first call.
bool search_fast_path(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
                      Eigen::Ref<Eigen::MatrixXd> solutions);

/// Eight descents within limits from branches that exceed these least; the first that arrives goes
/// into q. Says whether one did. Does not allocate but at the first call.
bool solve_from(InverseMethods& methods, const Pose& goal, const LeastOutside& outside,
                double tolerance, Eigen::Ref<Configuration> q);

/// Fills in status, residual, nearest miss and reason of a result without solutions; or, where it
/// comes upon one, that.
void explain(InverseMethods& methods, const Request& request,
             const UnconstrainedResult& unconstrained, InverseResult& result);

}  // namespace beeline::internal

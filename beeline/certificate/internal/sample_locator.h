#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/internal/path_tracker.h>
#include <beeline/path/tool_path.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The path parameters of consecutive samples.
struct SampleParameters {
  std::vector<double> path_parameters;
  bool reached = false;  ///< whether the last sample is at the stop
};

/// Finds where on a route the samples of a trajectory are.
class SampleLocator {
 public:
  /// All arguments except the task and the tolerance must outlive the object. `world_T_tool` has
  /// the poses at the samples.
  SampleLocator(const Arm& arm, const Trajectory& trajectory, const Route& route, const Task& task,
                const Deviation& tolerance, std::span<const Pose> world_T_tool, BudgetMeter& budget)
      : arm_(arm),
        trajectory_(trajectory),
        route_(route),
        task_(task),
        tolerance_(tolerance),
        world_T_tool_(world_T_tool),
        budget_(budget) {}

  /// Returns the parameters of the samples from `first` on, along the segments from `begin` to
  /// `last`. The tool stops at the end of `last`. The result ends at the sample nearest to the stop
  /// or, if none is there, at the first sample that is off the path. It is incomplete if the budget
  /// ends the search.
  SampleParameters from(std::size_t first, std::size_t begin, std::size_t last) const;

 private:
  struct Located;

  bool near(const Deviation& deviation) const { return within(deviation, tolerance_); }
  double closing_parameter(std::size_t begin, std::size_t segment) const;
  Located locate(std::size_t first, const PathTracker& tracker, std::size_t begin,
                 std::size_t segment) const;
  void make_consistent(const PathTracker& tracker, std::size_t first, Located& found) const;
  double moved(const PathTracker& tracker, std::size_t k) const;

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Route& route_;
  Task task_;
  Deviation tolerance_;
  std::span<const Pose> world_T_tool_;
  BudgetMeter& budget_;
};

}  // namespace beeline::internal

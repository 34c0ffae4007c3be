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
  bool reached = false;  ///< the last one is that of the stop
};

/// Finds where on a route the samples of a trajectory are.
class SampleLocator {
 public:
  /// All arguments but the task and the tolerance must outlive the object. `world_T_tool`: at the
  /// samples.
  SampleLocator(const Arm& arm, const Trajectory& trajectory, const Route& route, const Task& task,
                const Deviation& tolerance, std::span<const Pose> world_T_tool, BudgetMeter& budget)
      : arm_(arm),
        trajectory_(trajectory),
        route_(route),
        task_(task),
        tolerance_(tolerance),
        world_T_tool_(world_T_tool),
        budget_(budget) {}

  /// The parameters of the samples from `first` on, along the segments from `begin` to `last`, at
  /// whose end the tool stops: up to the sample nearest to the stop or, if none is there, to the
  /// first that is off the path. Incomplete where the budget ends it.
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

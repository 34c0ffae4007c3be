#pragma once

#include <deque>

#include <beeline/planning/internal/section_path.h>
#include <beeline/timing/internal/section.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

struct TimedPlan {
  Trajectory trajectory = {};                ///< from rest to rest
  std::vector<double> path_parameters = {};  ///< of each sample
};

/// The timing of a complete branch along the route's path from stop to stop
/// (timing/internal/section.h).
class PlanTiming {
 public:
  /// `tolerance`: the joint path leaves the tool path by about so much at most. It passes through
  /// `samples` of each of the branch's segments, at most, and those that the tolerance needs. Keeps
  /// references to the arm, the route and the task.
  PlanTiming(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
             const Deviation& tolerance, std::size_t samples, const RetimeOptions& options,
             BudgetMeter& budget);

  MotionStatus status = MotionStatus::reached;
  Reason reason = {};  ///< unless reached

  /// Returns the samples, of the sections before the budget ended; where there are none at the
  /// rate, sets status and reason.
  TimedPlan sample();

  void set_rate(double rate) { options_.rate = rate; }

  /// From now on there are `times` as many samples between sample k and the next, if `times[k]` is
  /// above 1. For samples without a rate.
  void divide(const std::vector<int>& times);

 private:
  struct Section {
    SectionPath path;
    TimedPath timed;
    std::vector<double> required;  ///< parameters of the joint path that get a sample
    double end = 0;                ///< the path parameter, after segments at rest too
    std::vector<double> sampled;   ///< parameters of the last samples
    ToolSpeeds tool_speeds = {};   ///< along the joint path; of one speed if it is the same
  };

  /// Adds the section along these segments of the route.
  void add(BranchSection samples, const Deviation& tolerance, std::size_t first, std::size_t last);
  ToolSpeeds tool_speeds(const SectionPath& path, std::size_t first, std::size_t last) const;

  const Arm& arm_;
  const Route& route_;
  const Task& task_;
  RetimeOptions options_;
  BudgetMeter& budget_;
  Configuration start_;
  double start_parameter_ = 0;
  std::deque<Section> sections_;
};

}  // namespace beeline::internal

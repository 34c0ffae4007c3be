#pragma once

#include <deque>

#include <beeline/planning/internal/section_joint_path.h>
#include <beeline/timing/internal/sampled_section.h>

namespace beeline::internal {

/// A branch with times: a trajectory from rest to rest, or the reason why there is none.
struct TimedBranch {
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};  ///< unless reached
  Trajectory trajectory = {};
  std::vector<double> path_parameters = {};  ///< of each sample
};

/// The timing of a complete branch, section by section from stop to stop: joint path, time scaling
/// and samples of each.
class BranchTiming {
 public:
  /// The joint path passes through at most `samples` of each of the branch's segments, and through
  /// the samples that the tolerance needs. Keeps references to the request and the budget.
  BranchTiming(const MotionRequest& request, const Branch& branch, std::size_t samples,
               BudgetMeter& budget);

  /// Returns the samples at a rate (RetimeOptions::rate) of all sections before the budget ended,
  /// or the reason why no samples at the rate are within limits.
  TimedBranch sample(double rate);

  /// The shortest duration of all sections, s: what their time scalings take.
  double shortest_duration() const;

  /// Multiplies the number of samples between sample k and the next by `times[k]` if this is above
  /// 1. For samples without a rate.
  void divide(const std::vector<int>& times);

 private:
  struct Section {
    SectionJointPath path;
    SectionOptions options;
    double end = 0;  ///< the path parameter, after segments at rest too
    TimedSection timed = {};
    std::vector<double> sampled = {};  ///< parameters of the last samples
  };

  /// Adds the section along these segments of the route.
  void add(BranchSection samples, std::size_t first, std::size_t last);
  /// Adds the samples next to stops that linear joints need.
  void grade_stops();
  ToolSpeeds tool_speeds(const SectionJointPath& path, std::size_t first, std::size_t last) const;

  const MotionRequest& request_;
  BudgetMeter& budget_;
  Reason reason_ = {};  ///< why a section has no time scaling
  Configuration start_;
  double start_parameter_ = 0;
  std::deque<Section> sections_;
};

}  // namespace beeline::internal

#include <algorithm>
#include <cmath>

#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/internal/self_motion_branches.h>
#include <beeline/math/minimise.h>

namespace beeline::internal {
namespace {

/// The branches over the range of the redundant joint, lane by lane.
class RangeExamination {
 public:
  RangeExamination(LockedRequest& locked, LeastOutside& outside, int intervals)
      : locked_(locked),
        outside_(outside),
        intervals_(std::clamp(intervals, 1, max_range_intervals)) {}

  ExaminedRange run() {
    for (int i = 0; i <= intervals_ && !done(); ++i) {
      evaluate(value(i), samples_[i]);
      clean_ &= !samples_[i].hidden;
    }
    for (int lane = 0; lane < 8; ++lane) {
      for (int i = 0; i <= intervals_ && !done(); ++i) {
        if (is_minimum(lane, i)) examine_minimum(lane, i);
        if (i < intervals_ && ends_near_zero(lane, i)) refine(lane, i, i + 1);
      }
    }
    const bool away = outside_.count == 0 || outside_.excess[0] > near;
    return {branch_, clean_ && away && !locked_.request.budget.ended()};
  }

 private:
  /// Returns the cost of each lane: its excess over the limits or, without a solution, `none` plus
  /// the residual of the loop.
  struct Sample {
    double cost[8];
    bool hidden;  ///< whether rounding may hide a solution
    bool found(int lane) const { return cost[lane] < none; }
  };
  static constexpr double none = no_solution;
  // Branches that come nearer to the limits, and loops that are nearer to closing, radians or
  // metres, may be solutions to rounding.
  static constexpr double near = 1e-5;

  bool done() const { return branch_.lane >= 0 || locked_.request.budget.ended(); }

  double value(int i) const {
    const LockedRange& range = locked_.range;
    return range.lower + (range.upper - range.lower) * i / intervals_;
  }

  void evaluate(double value, Sample& sample) {
    internal::evaluate(locked_, value, branch_);
    const PieperBranches& found = branch_.found;
    if (branch_.lane < 0 && found.within != 0) clean_ = false;  // a loop that does not close
    clean_ &= found.continuum == 0;
    sample.hidden = nearly_found(locked_.form, found);
    for (int lane = 0; lane < 8; ++lane) {
      const bool solved = (found.found >> lane & 1) != 0;
      sample.cost[lane] = solved ? found.excess[lane] : none + found.residual[lane];
    }
  }

  bool is_minimum(int lane, int i) const {
    const double here = samples_[i].cost[lane];
    return (i == 0 || here <= samples_[i - 1].cost[lane]) &&
           (i == intervals_ || here < samples_[i + 1].cost[lane]);
  }

  /// Whether a branch that ends between the values i and i + 1 may have zero excess there. Joints
  /// move fast next to the end.
  bool ends_near_zero(int lane, int i) const {
    constexpr double fast = 0.5;  // radians in one interval
    return samples_[i].found(lane) != samples_[i + 1].found(lane) &&
           std::min(samples_[i].cost[lane], samples_[i + 1].cost[lane]) < fast;
  }

  void examine_minimum(int lane, int i) {
    const int before = std::max(i - 1, 0), after = std::min(i + 1, intervals_);
    if (may_reach_zero(samples_[i].cost[lane], samples_[before].cost[lane],
                       samples_[after].cost[lane])) {
      refine(lane, before, after);
    } else if (samples_[i].found(lane)) {
      Sample sample{};
      evaluate(value(i), sample);
      outside_.insert(locked_.form, branch_, lane);
    }
  }

  /// The lanes without a solution whose cost is the lane's, to rounding, so that they have the same
  /// minimum: the signs of two square roots near zero do not matter.
  static unsigned twins(const Sample& sample, int lane) {
    constexpr double rounding = 1e-9;  // radians or metres
    unsigned same = 0;
    for (int other = 0; other < 8 && !sample.found(lane); ++other) {
      const bool alike = std::abs(sample.cost[other] - sample.cost[lane]) < rounding;
      same |= static_cast<unsigned>(alike) << other;
    }
    return same;
  }

  /// Minimises the cost of a lane between the values from and to, more precisely where it is small.
  void refine(int lane, int from, int to) {
    unsigned& refined = refined_[from][to - from - 1];
    if ((refined >> lane & 1) != 0) return;
    constexpr int sections = 13, more = 20;
    constexpr double small = 1e-2;         // radians or metres
    constexpr double shorter = 0.0019201;  // fraction of the interval, 0.618^sections
    // Beyond the end of a branch its solutions are hidden by rounding.
    const bool ends = samples_[from].found(lane) != samples_[to].found(lane);
    Sample sample{};
    unsigned same = twins(samples_[from], lane) & twins(samples_[to], lane);
    const auto cost = [&](double value) {
      if (!done()) evaluate(value, sample);
      same &= twins(sample, lane);
      clean_ &= ends || sample.found(lane) || !sample.hidden;
      return sample.cost[lane];
    };
    Minimum least = golden_section(value(from), value(to), sections, cost);
    if (least.value < small || (least.value > none && least.value < none + small)) {
      const double width = 2 * shorter * (value(to) - value(from));
      least = golden_section(std::max(value(from), least.x - width),
                             std::min(value(to), least.x + width), more, cost);
    }
    if (done()) return;
    evaluate(least.x, sample);
    if (done()) return;
    refined |= same & twins(sample, lane);
    if (sample.found(lane)) outside_.insert(locked_.form, branch_, lane);
    clean_ &= sample.found(lane) || least.value > none + near;
  }

  LockedRequest& locked_;
  LeastOutside& outside_;
  const int intervals_;
  Sample samples_[max_range_intervals + 1]{};
  /// For each interval, and for each pair of neighbours, the lanes whose minimum is known.
  unsigned refined_[max_range_intervals][2] = {};
  LockedBranch branch_;
  bool clean_ = true;
};

}  // namespace

ExaminedRange examine_range(LockedRequest& locked, LeastOutside& outside, int intervals) {
  return RangeExamination(locked, outside, intervals).run();
}

}  // namespace beeline::internal

#include <algorithm>
#include <cmath>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/planning/internal/motion_proof.h>

namespace beeline::internal {

std::size_t prove(const Arm& arm, const Route& route, const Task& task,
                  const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion) {
  motion.path = route.path;
  motion.arrivals = arrivals(motion.path_parameters);
  Verification proof = verify(arm, motion.trajectory, route,
                              {.task = task,
                               .tolerance = options.tolerance,
                               .orientation_tolerance = options.orientation_tolerance,
                               .budget = budget.part()});
  motion.deviation = std::move(proof.deviation);
  if (proof.ending != Ending::complete) return 0;
  motion.limits = limit_usage(arm, motion.trajectory, budget.part());
  if (motion.limits.ending != Ending::complete || proof) return 0;
  motion.deviation = path_deviation(arm, motion.trajectory, motion.path_parameters, route.path,
                                    task, budget.part());
  const Deviation& bound = motion.deviation.bound;
  motion.status = MotionStatus::not_proved;
  motion.reason = within(bound, {options.tolerance, options.orientation_tolerance})
                      ? std::move(proof.reason)
                      : deviation_reason(ReasonCode::path_not_proved, bound);
  return std::min(proof.sample, motion.trajectory.size() - 2);
}

std::vector<int> divisions(const PathDeviation& deviation, std::size_t faulty,
                           const PathMotionOptions& options) {
  constexpr double most = 8;  // at once
  const double power = options.interpolation == Interpolation::linear ? 0.5 : 0.25;
  std::vector<int> times;
  int all = 0;
  for (const Deviation& bound : deviation.interval_bounds) {
    const double excess = std::max(bound.position / options.tolerance,
                                   bound.orientation / options.orientation_tolerance);
    times.push_back(
        excess <= 1 ? 1
                    : static_cast<int>(std::ceil(std::min(most, 1.01 * std::pow(excess, power)))));
    if (times.back() < 2 && (excess > 1 || times.size() == faulty + 1)) times.back() = 2;
    all += times.back();
  }
  if (all >= options.max_samples) times.clear();
  return times;
}

}  // namespace beeline::internal

#include <algorithm>
#include <cmath>

#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/timing/internal/recovery_section.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {
namespace {

constexpr double nearest_dwell = 1e-9;  // seconds: shorter dwells have no sample

}  // namespace

void ProgramTrajectory::begin(const Arm& arm, const Configuration& q, Interpolation interpolation,
                              double rate) {
  rate_ = rate;
  trajectory_ = at_rest(arm, q);
  keep_columns(trajectory_, interpolation);
}

void ProgramTrajectory::rest_before(double interval) {
  std::vector<double>& t = trajectory_.times;
  const std::size_t count = t.size();
  if (count < 2 || !is_linear()) return;
  const bool rests = positions()[count - 1] == positions()[count - 2];
  const std::size_t end = rests ? count - 2 : count - 1;  // of the motion before
  const double before = end > 0 ? t[end] - t[end - 1] : 0;
  const double shortest = std::max(before, interval);
  if (rests) {
    t.back() = std::max(t.back(), t[end] + shortest);
  } else if (before != interval) {
    append_sample(trajectory_, trajectory_, last(), t.back() + shortest);
  }
}

void ProgramTrajectory::append(const Trajectory& motion, std::size_t k) {
  if (stopped_) rest_before(motion.times[k] - motion.times[k - 1]);
  stopped_ = false;
  append_sample(trajectory_, motion, k,
                trajectory_.times.back() + motion.times[k] - motion.times[k - 1]);
}

void ProgramTrajectory::append(const Trajectory& motion) {
  for (std::size_t k = 1; k < motion.size(); ++k) append(motion, k);
}

Reason ProgramTrajectory::joint_move(const Arm& arm, const Configuration& to,
                                     const RetimeOptions& options) {
  constexpr double still = 1e-12;  // radians or metres
  if ((to - positions().back()).norm() <= still) return {};
  const Trajectory ends{trajectory_.joint_names, {0, 1}, {positions().back(), to}, {}, {}};
  const Retimed motion = retime(arm, ends, options);
  if (!motion) return motion.reason;
  append(motion.trajectory);
  return {};
}

Reason ProgramTrajectory::recover(const Arm& arm, const RetimeOptions& options,
                                  BudgetMeter& budget) {
  if (largest_excess(arm, positions().back()) <= position_slack) return {};
  const Retimed section = recovery_section(arm, positions().back(), options, budget);
  if (!section) return section.reason;
  append(section.trajectory);
  stop();
  return {};
}

Reason ProgramTrajectory::dwell(double seconds) {
  constexpr double rounding = 1e-6;                // of a period
  constexpr std::size_t max_samples = 10'000'000;  // some 3 GB for seven joints
  const double needed = static_cast<double>(last()) + seconds * rate_;
  if (needed > static_cast<double>(max_samples)) {
    return {ReasonCode::program_too_long, {{ReasonField::max_samples, max_samples}}};
  }
  if (seconds < nearest_dwell) return {};
  const std::vector<double>& t = trajectory_.times;
  if (is_linear() && t.size() > 1) seconds = std::max(seconds, t.back() - t[t.size() - 2]);
  const double periods = rate_ > 0 ? std::max(1.0, std::ceil(seconds * rate_ - rounding)) : 1;
  const double period = rate_ > 0 ? 1 / rate_ : seconds;
  for (double k = 0; k < periods; ++k) {
    append_sample(trajectory_, trajectory_, last(), trajectory_.times.back() + period);
  }
  return {};
}

Trajectory ProgramTrajectory::finished() const {
  Trajectory trajectory = trajectory_;
  for (std::size_t k = 0; rate_ > 0 && k < trajectory.size(); ++k) {
    trajectory.times[k] = static_cast<double>(k) / rate_;
  }
  round_times(trajectory);
  return trajectory;
}

}  // namespace beeline::internal

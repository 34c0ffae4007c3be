#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/control/internal/played_section.h>
#include <beeline/control/internal/speed_schedule.h>
#include <beeline/trajectory/internal/end_velocity.h>

namespace beeline::internal {
namespace {

constexpr double averaged_ramp = 0.2;  // width of the moving average, as a fraction of the ramp
// Fraction of the ramp's rate; a recording at its limits must be able to pause.
constexpr double min_ramp_rate = 0.05;

/// Whether all coordinates start at rest.
bool starts_at_rest(const Arm& arm, const Trajectory& recording) {
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits limits = motion_limits(arm.limits(i));
    if (!end_velocity(recording, i, limits, TrajectoryEnd::first).at_rest()) return false;
  }
  return true;
}

class SpeedSimulation {
 public:
  SpeedSimulation(const Arm& arm, const Trajectory& recording, const SpeedSchedule& schedule)
      : arm_(arm),
        recording_(recording),
        schedule_(schedule),
        period_(1 / schedule.rate),
        ramp_rate_(schedule.scale * schedule.scale / schedule.options.ramp),
        target_(schedule.options.speed) {
    const double width = averaged_ramp * schedule.options.ramp * schedule.rate;
    window_ = static_cast<std::size_t>(std::clamp(std::round(width), 1.0, max_window));
  }

  std::vector<ParameterState> run() {
    const double first = starts_at_rest(arm_, recording_) ? schedule_.scale * first_target() : 0;
    speeds_.assign(window_ + 1, first);
    simulated_ = {recording_.times.front(), first, 0};
    progress_ = {simulated_};
    for (const RecordedSection& section : schedule_.sections) {
      const double end = recording_.times[section.end];
      const std::size_t begin = progress_.size() - 1;
      while (progress_.back().s < end) {
        if (schedule_.budget.ended()) return std::move(progress_);
        const auto steps = static_cast<double>(progress_.size());
        check_samples(steps, steps * period_, schedule_.rate);
        set_target();
        step();
      }
      stretch(begin, end);
    }
    return std::move(progress_);
  }

 private:
  static constexpr double max_window = 1000;

  double first_target() {
    set_target();
    return target_;
  }

  /// Applies the changes whose time has come.
  void set_target() {
    const double equal = 1e-6 * period_;
    const auto sample = static_cast<double>(schedule_.first + progress_.size());
    const double now = (progress_.empty() ? sample : sample - 1) * period_;
    const auto& changes = schedule_.options.speed_at;
    for (; next_change_ < changes.size() && changes[next_change_].time <= now + equal;
         ++next_change_) {
      target_ = changes[next_change_].speed;
    }
  }

  /// Returns the rate of change of the speed, as near to the wanted one as the acceleration limits
  /// allow.
  double speed_rate(double wanted) const {
    const ParameterState& now = simulated_;
    const TrajectoryState state = sample(recording_, now.s);
    double low = -ramp_rate_, high = ramp_rate_;
    for (int i = 0; i < arm_.dof(); ++i) {
      const double limit = motion_limits(arm_.limits(i)).acceleration;
      const double v = std::abs(state.velocity[i]);
      if (!(v > 0)) continue;
      const double a =
          now.speed * now.speed * state.acceleration[i] * (state.velocity[i] < 0 ? -1 : 1);
      low = std::max(low, (-limit - a) / v);
      high = std::min(high, (limit - a) / v);
    }
    const double least = min_ramp_rate * ramp_rate_;
    return wanted < 0 ? std::max(wanted, std::min(low, -least))
                      : std::min(wanted, std::max(high, least));
  }

  void step() {
    const double before = speeds_.back();
    const double wanted =
        std::clamp((schedule_.scale * target_ - before) / period_, -ramp_rate_, ramp_rate_);
    const double target = schedule_.scale * target_;
    double speed = before + period_ * speed_rate(wanted);
    if ((before - target) * (speed - target) <= 0 && std::abs(speed - target) < 1e-15) {
      speed = target;
    }
    speeds_.push_back(std::max(0.0, speed));
    const std::size_t now = speeds_.size() - 1, begin = now - window_;
    double sum = (speeds_[begin] + speeds_[now]) / 2;
    for (std::size_t k = begin + 1; k < now; ++k) sum += speeds_[k];
    const double count = static_cast<double>(window_);
    const ParameterState& last = simulated_;
    ParameterState next{0, sum / count, (speeds_[now] - speeds_[begin]) / (count * period_)};
    // The averaged speed is quadratic between samples.
    next.s = last.s + period_ * (last.speed + next.speed) / 2 -
             period_ * period_ * (next.acceleration - last.acceleration) / 12;
    next.s = std::max(next.s, last.s);
    progress_.push_back(next);
    simulated_ = next;
  }

  /// Slows the samples after `first` down by up to a period, so that the last one is at `end`.
  void stretch(std::size_t first, double end) {
    const double begin = progress_[first].s;
    const double passed = progress_.back().s - begin;
    if (!(passed > 0)) return;
    const double factor = (end - begin) / passed;
    // At a stop the speed is the speed of the section before it.
    for (std::size_t k = first == 0 ? 0 : first + 1; k < progress_.size(); ++k) {
      ParameterState& now = progress_[k];
      now = {begin + factor * (now.s - begin), factor * now.speed, factor * now.acceleration};
    }
    simulated_.s = progress_.back().s = end;
  }

  const Arm& arm_;
  const Trajectory& recording_;
  const SpeedSchedule& schedule_;
  double period_, ramp_rate_, target_;
  std::size_t window_ = 1, next_change_ = 0;
  /// Speeds before averaging; the first is `window_` samples before the beginning.
  std::vector<double> speeds_;
  std::vector<ParameterState> progress_;
  ParameterState simulated_ = {};  ///< the last state, before its section was slowed down
};

}  // namespace

std::vector<ParameterState> scheduled_progress(const Arm& arm, const Trajectory& recording,
                                               const SpeedSchedule& schedule) {
  return SpeedSimulation(arm, recording, schedule).run();
}

}  // namespace beeline::internal
